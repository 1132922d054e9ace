// `feedhold ranges FILE[:LINE]`: what is known before each block, for all inputs.
#include "inference/absint/analysis.h"
#include "inference/absint/describe.h"
#include "language/parse/parse.h"
#include "surface/cli/dump_input.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

class Printer : public AnalysisVisitor {
public:
  Printer(const ProgramSet &programs, const ModalTable &modes) : programs_(programs), modes_(modes) {}

  void visit(Place place, const AbstractState &state, std::span<const Place> calls) override {
    const ProgramFile &file = programs_.file(place.file);
    const Block &block = file.tree->blocks[programs_.node(place).block];
    text += fmt::format("{}{}: {}\n", std::string(2 * calls.size(), ' '),
                        file.source->position(block.begin).line, file.source->text(block.span()));
    const StateDescription description = describe(state, modes_, programs_);
    for (const auto *facts : {&description.variables, &description.positions, &description.modes})
      for (const StateFact &fact : *facts)
        text += fmt::format("      {:<10} {} {}\n", fact.name, fact.value, fact.relation);
  }
  std::string text;

private:
  const ProgramSet &programs_;
  const ModalTable &modes_;
};

std::string ranges(const SourceFile &source, const Dialect &dialect) {
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  CallGraph graph({{FileId(0), "", "", &model}});
  const ProgramSet programs({{FileId(0), &source, &tree, &model, &dialect}}, graph);
  const ModalTable modes(dialect);
  Printer printer(programs, modes);
  Analysis analysis(programs);
  for (std::size_t i = 0; i < model.programs.size(); ++i)
    analysis.walk({FileId(0), programs.file(FileId(0)).cfg.entryOf(ProgramId(i)), ProgramId(i)}, printer);
  return printer.text;
}

} // namespace

Command addRangesCommand(CLI::App &parent) {
  return addDumpCommand(parent, "ranges", "print what is known before each block, for all inputs", ranges);
}

} // namespace feedhold
