// Sample start: a program as it is loaded, and what a run of it starts from.
#pragma once

#include "language/parse/parse.h"
#include "meaning/cfg/program_set.h"
#include "soundness/containment.h"
#include "soundness/macro_programs.h"

namespace feedhold::soundness {

/// The control as the analysis knows it, and as one machine has it: parameters that are unknown there are set here.
class LoadedSample {
public:
  LoadedSample(const ProgramLines &lines, Dialect dialect)
      : dialect_(std::move(dialect)), source_(SourceFile::fromText("sample.nc", textOf(lines))),
        tree_(parse(source_, dialect_)), model_(resolve(source_, tree_, dialect_)),
        set({{FileId(0), &source_, &tree_, &model_, &dialect_}}, CallGraph({{FileId(0), "", "", &model_}})) {}
  LoadedSample(const LoadedSample &) = delete;
  LoadedSample &operator=(const LoadedSample &) = delete;

  /// The first program, but for subroutines that stand before it.
  Callee main() const {
    ProgramId main(0);
    for (ProgramId id(0); id.index() < model_.programs.size(); id = id.next())
      if (dialect_.grammar.oWords && model_.programs[id].first.index() < model_.programs[main].first.index())
        main = id;
    return {FileId(0), set.file(FileId(0)).cfg.entryOf(main), main};
  }
  bool isEmpty() const { return model_.programs.empty(); }
  std::string blockOf(Place place) const {
    return std::string(source_.text(tree_.blocks[set.node(place).block].span()));
  }
  const Dialect &dialect() const { return dialect_; }
  const SourceFile &source() const { return source_; }
  const SyntaxTree &tree() const { return tree_; }
  const ProgramModel &model() const { return model_; }

private:
  Dialect dialect_;
  SourceFile source_;
  SyntaxTree tree_;
  ProgramModel model_;

public:
  ProgramSet set;
};

const Dialect &controlOf(const Sample &sample);
Dialect machineOf(const Sample &sample, Random &random);

/// Those of the control as the analysis knows it; either, where it does not.
NumberModel numbersOfMachine(const Dialect &control, Random &random);

/// Any values, codes, words and shifts; an assumption of the analyses: polar coordinates and mappings are not in force.
EntryValues randomEntry(const LoadedSample &machine, Random &random);
/// On a machine that computes in these numbers.
EntryValues randomEntryIn(NumberModel numbers, const LoadedSample &machine, Random &random);

} // namespace feedhold::soundness
