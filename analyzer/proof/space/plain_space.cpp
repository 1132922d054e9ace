#include "proof/space/plain_space.h"

#include "proof/space/contract_numbers.h"
#include "proof/space/region_shapes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace feedhold::prove {

namespace {

using PlainShapes = RegionShapes<double, bool>;

/// `partsOf`: the shapes of one region.
template <typename Parts>
std::vector<geometry::PlainRegion> named(const std::vector<Region> &regions, const Parts &partsOf) {
  std::vector<geometry::PlainRegion> result;
  for (const std::string &name : namesOf(regions)) {
    geometry::PlainRegion region{name, {}};
    for (const Region &part : regions)
      if (part.name == name)
        std::ranges::move(partsOf(part), std::back_inserter(region.parts));
    result.push_back(std::move(region));
  }
  return result;
}

/// The nose of the tool, whichever offset it is; `@OFFSET` tells offsets of D.
std::optional<CutterOffset<double>> noseIn(const Contract &contract, ContractNumbers &numbers) {
  if (!contract.tool || !contract.offsets.empty())
    return std::nullopt;
  return CutterOffset<double>{.radius = numbers.number(contract.tool->radius),
                              .tip = tipDirection(contract.tool->direction)};
}

/// Of a range its lower end.
std::optional<CutterOffset<double>> offsetIn(const ProgramSet &programs, Callee program, const FileContracts &contracts,
                                             const RunOptions &run, double number) {
  ContractNumbers numbers(programs, program, contracts, run);
  const Contract &contract = *contracts.of(program.program);
  if (programs.file(program.file).dialect->machine == MachineKind::Turning)
    return noseIn(contract, numbers);
  const RadiusOffset *found = nullptr;
  for (const RadiusOffset &offset : contract.offsets)
    if (offset.number ? numbers.number(*offset.number) == number : found == nullptr)
      found = &offset;
  if (found != nullptr)
    return CutterOffset<double>{numbers.number(found->radius.low ? *found->radius.low : *found->radius.high)};
  const double radius = contract.tool ? numbers.number(contract.tool->radius) : 0;
  return contract.offsets.empty() && radius > 0 ? std::optional(CutterOffset<double>{radius, true}) : std::nullopt;
}

/// Absent: a clause gives no upper end.
std::optional<double> longestLength(const Contract &contract, ContractNumbers &numbers) {
  std::optional<double> longest;
  for (const LengthRange &each : contract.lengths) {
    if (!each.length.high)
      return std::nullopt;
    longest = std::max(longest.value_or(-HUGE_VAL), numbers.number(*each.length.high));
  }
  return longest;
}

} // namespace

geometry::PlainSpace plainSpace(const ProgramSet &programs, Callee program, const FileContracts &contracts,
                                const RunOptions &run) {
  geometry::PlainSpace space;
  const Contract *contract = contracts.of(program.program);
  if (contract == nullptr)
    return space;
  const auto numbers = std::make_shared<ContractNumbers>(programs, program, contracts, run);
  PlainShapes shapes{[numbers](ExpressionId expression) { return numbers->number(expression); },
                     [numbers](ExpressionId condition, const geometry::Point<double> &point) {
                       return numbers->holds(condition, point);
                     }};
  if (programs.file(program.file).dialect->machine == MachineKind::Turning) {
    shapes.lathe = {[](double number) { return number / 2; }, [](double number) { return number * 2; },
                    [](double number) { return -number; }, [](double number) { return std::abs(number); }, 0};
    space.tip = tipDirection(contract->tool ? contract->tool->direction : 0);
  }
  if (contract->tool)
    space.tool = shapes.tool(*contract->tool, 0);
  space.keepIn = named(contract->keepIn, [&](const Region &region) { return std::vector{shapes.keptIn(region)}; });
  space.keepOut = named(contract->keepOut, [&](const Region &region) { return shapes.keptOut(region); });
  if (contract->clearance)
    space.clearance = numbers->number(contract->clearance->height.value);
  if (contract->travel)
    space.travel = shapes.sides(contract->travel->box);
  space.knowsLengths = !contract->lengths.empty();
  space.longest = longestLength(*contract, *numbers);
  if (contract->machine)
    space.machine = shapes.sides(contract->machine->box);
  space.corner = cornerOf(*contract).toDouble();
  return space;
}

double numberOf(const ProgramSet &programs, Callee program, const FileContracts &contracts, const RunOptions &run,
                ExpressionId expression) {
  return ContractNumbers(programs, program, contracts, run).number(expression);
}

RunOptions startedAsSaid(const ProgramSet &programs, Callee program, const FileContracts &contracts, RunOptions run) {
  const Contract *contract = contracts.of(program.program);
  if (contract == nullptr)
    return run;
  const Dialect &dialect = *programs.file(program.file).dialect;
  const ModalTable modes(dialect);
  for (const ModalCode &code : contract->modal) {
    const Code *row = code.address == 'G' ? findGCode(dialect, code.tenths) : nullptr;
    if (const auto index = row ? modes.indexOf(*row) : std::nullopt)
      run.codes.emplace_back(row->group, *index);
  }
  ContractNumbers numbers(programs, program, contracts, run);
  if (contract->start)
    for (const AxisValue &axis : contract->start->axes)
      if (const auto known = axisOf(axis.axis))
        run.start[indexOf(*known)] = numbers.number(axis.value);
  return run;
}

AxisSet fixedAxes(const Contract &contract) {
  AxisSet axes;
  for (const char letter : contract.fixed ? contract.fixed->axes : std::string())
    if (const auto axis = axisOf(letter))
      axes.set(indexOf(*axis));
  return axes;
}

RunOptions followedAsSaid(const ProgramSet &programs, Callee program, const FileContracts *contracts, RunOptions run) {
  run.cutter = CutterCompensation::Followed;
  const Contract *contract = contracts == nullptr ? nullptr : contracts->of(program.program);
  if (contract != nullptr)
    run.fixed = fixedAxes(*contract);
  if (contract != nullptr && (contract->tool || !contract->offsets.empty()))
    run.cutterRadius = [&programs, program, contracts](const RunOptions &started, double number) {
      return offsetIn(programs, program, *contracts, started, number);
    };
  return run;
}

} // namespace feedhold::prove
