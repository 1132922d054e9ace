// A few files of one control in one folder, loaded, and what the three interpretations say of them.
#pragma once

#include "dialects/registry.h"
#include "inference/absint/block_states.h"
#include "language/contract/contract.h"
#include "language/parse/parse.h"
#include "meaning/machine/machine.h"
#include "proof/prove/prove.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace feedhold {

class LanguageSample {
public:
  LanguageSample(const Dialect &dialect, const std::vector<std::string> &texts) : dialect_(dialect) {
    std::vector<ProgramFile> files;
    std::vector<ModelledFile> names;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const Part &part = *parts_.emplace_back(std::make_unique<Part>(texts[i], dialect_));
      files.push_back({FileId(i), &part.source, &part.tree, &part.model, &dialect_});
      names.push_back({FileId(i), "", "f" + std::to_string(i), &part.model});
    }
    set = std::make_unique<ProgramSet>(std::move(files), CallGraph(std::move(names)));
  }

  Callee main() const { return {FileId(0), set->file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)}; }

  RunResult run(const GivenVariables &given = {}) const {
    RunOptions options;
    options.variables = given;
    options.fuel = 10'000;
    return feedhold::run(*set, main(), options);
  }

  /// What ranges tell of a variable before the block that begins with the text; absent where no run comes there.
  std::optional<AbstractValue> valueBefore(std::string_view text, std::uint32_t variable) const {
    const BlockStates states = collectBlockStates(*set, std::array{main()}, [](FileId, BlockId) { return true; });
    gaveUp = states.gaveUp.has_value();
    const Part &part = *parts_.front();
    for (const ContextStates &context : states.contexts)
      for (const auto &[block, kept] : context.blocks)
        if (part.source.text(part.tree.blocks[block].span()).starts_with(text)) {
          const AbstractState state = kept.state();
          const auto *value = state.variables.find(cellOf(dialect_, variable));
          return variable <= kLocalVariables ? state.locals[variable] : value ? *value : AbstractValue::any();
        }
    return std::nullopt;
  }

  std::vector<prove::Obligation> obligations() const {
    std::vector<FileContracts> contracts;
    std::vector<const FileContracts *> pointers;
    for (const auto &part : parts_)
      contracts.push_back(readContracts(part->source, part->tree, part->model, dialect_));
    for (const FileContracts &each : contracts)
      pointers.push_back(&each);
    return prove::prove(*set, main(), pointers.front(), {.guards = prove::InferGuards::No, .contractsOf = pointers})
        .obligations;
  }
  /// The worst verdict on `#3000=`; absent: there is no row.
  std::optional<prove::Verdict> userAlarm() const {
    std::optional<prove::Verdict> worst;
    for (const prove::Obligation &row : obligations())
      if (row.kind == prove::ObligationKind::AlarmUnreachable)
        worst = !worst || holds(*worst) ? row.verdict : *worst;
    return worst;
  }

  std::unique_ptr<ProgramSet> set;
  mutable bool gaveUp = false;

private:
  struct Part {
    Part(const std::string &text, const Dialect &dialect)
        : source(SourceFile::fromText("t.nc", text)), tree(parse(source, dialect)),
          model(resolve(source, tree, dialect)) {}
    SourceFile source;
    SyntaxTree tree;
    ProgramModel model;
  };
  Dialect dialect_;
  std::vector<std::unique_ptr<Part>> parts_;
};

/// Those whose macro language is Macro B.
inline std::vector<const Dialect *> macroBDialects() {
  std::vector<const Dialect *> dialects;
  for (const Dialect *dialect : allDialects().dialects)
    if (!dialect->grammar.oWords)
      dialects.push_back(dialect);
  return dialects;
}

} // namespace feedhold
