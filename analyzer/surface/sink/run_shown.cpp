#include "surface/sink/run_shown.h"

#include <algorithm>

namespace feedhold {

namespace {

bool isLocal(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = findVariable(dialect, variable);
  return range && range->kind == VariableKind::Local;
}

bool standsInProgram(const RunReport &report, std::uint32_t variable) {
  const ProgramModel &model = *report.programs.file(report.result.place.file).model;
  const ProgramId program = model.programOf(blockAt(report, report.result.place));
  const auto uses = model.variablesOf(program);
  return std::any_of(uses.begin(), uses.end(), [&](const VariableUse &use) { return use.number == variable; });
}

} // namespace

std::vector<std::pair<std::string, ConcreteValue>> variablesOf(const RunReport &report) {
  const MachineState<ConcreteInterpretation> &state = report.result.state;
  const Dialect &dialect = *report.programs.file(report.result.place.file).dialect;
  const auto shown = [&](const ConcreteValue &value) {
    return value.vacant && !dialect.behaviour.variablesMayBeVacant ? ConcreteValue::of(0) : value;
  };
  std::vector<std::pair<std::string, ConcreteValue>> variables;
  for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
    if (isLocal(dialect, local) && (!state.locals[local].vacant || standsInProgram(report, local)))
      variables.emplace_back(report.programs.nameOfVariable(local), shown(state.locals[local]));
  for (const auto &[variable, value] : state.variables.entries())
    variables.emplace_back(report.programs.nameOfVariable(variable), shown(value));
  return variables;
}

bool showsNumbers(const RunReport &report) {
  const Dialect &dialect = *report.programs.file(report.start.file).dialect;
  return report.numbers != NumberModel::Binary64 || numbersOfRun(dialect) != NumberModel::Binary64;
}

std::vector<Axis> axesOf(const RunReport &report) {
  std::vector<Axis> axes;
  for (const Axis axis : kAllAxes) {
    const auto moves = [&](const RecordedMove &recorded) {
      return recorded.move.end[indexOf(axis)].number != 0 || recorded.move.start[indexOf(axis)].number != 0;
    };
    const bool isMain = axis == Axis::X || axis == Axis::Y || axis == Axis::Z;
    if (isMain || std::any_of(report.result.moves.begin(), report.result.moves.end(), moves))
      axes.push_back(axis);
  }
  return axes;
}

} // namespace feedhold
