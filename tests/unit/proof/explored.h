// A program from its text to its exploration, for tests of what proofs are made of.
#pragma once

#include "dialects/registry.h"
#include "language/parse/parse.h"
#include "proof/context/proof_context.h"
#include "proof/families/families.h"

#include <memory>
#include <string>
#include <string_view>

namespace feedhold::prove {

/// The first program of the text is the subject.
struct ParsedProgram {
  explicit ParsedProgram(std::string_view text)
      : source(SourceFile::fromText("t.nc", std::string(text))), tree(parse(source, dialect)),
        model(resolve(source, tree, dialect)),
        set({{FileId(0), &source, &tree, &model, &dialect}}, CallGraph({{FileId(0), "", "", &model}})) {}

  Callee main() const { return {FileId(0), set.file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)}; }
  std::size_t lineOf(Place place) const { return source.lineOf(tree.blocks[set.node(place).block].span().begin); }

  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  SourceFile source;
  SyntaxTree tree;
  ProgramModel model;
  ProgramSet set;
};

/// All paths of its first program, from any start.
struct Explored : ParsedProgram {
  explicit Explored(std::string_view text, ExploreOptions wish = {}) : ParsedProgram(text) {
    found = explore(start.interpretation(), set, main(), start.entry(), start.exploreOptions(subject, std::move(wish)));
  }

  ProofContext context() { return {{subject, start, found}, *runs(), promises, ends, nullptr, options.budget}; }
  WitnessSearch *runs() {
    if (!runs_)
      runs_ = std::make_unique<WitnessSearch>(sampledRuns(subject, start, {}));
    return runs_.get();
  }

  ProveOptions options;
  ProofSubject subject{set, main(), nullptr, options};
  ProofStart start{subject};
  Exploration found;
  BrokenPromises promises{subject, promiseQuestions};
  LoopEnds ends;

private:
  std::unique_ptr<WitnessSearch> runs_;
};

} // namespace feedhold::prove
