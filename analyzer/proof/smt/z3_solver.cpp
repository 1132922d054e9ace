// The only file that speaks Z3.
#include "base/support/process.h"
#include "proof/smt/s_expression.h"
#include "proof/smt/solver.h"

#include <z3++.h>

#include <algorithm>
#include <limits>
#include <shared_mutex>

namespace feedhold::smt {
namespace {

/// Against a Z3 that ignores its budget: many times what the budget takes, so that the load of the machine decides
/// nothing.
ProcessLimits limitsFor(std::uint64_t resources) {
  return {.processorSeconds = 2 + static_cast<std::uint32_t>(15 * resources / 1'000'000), .watchdogSeconds = 120};
}

/// Z3 does not count what its polynomials and long numbers cost: with them it may go on for minutes within its
/// resources.  It does count how often it takes memory, up to five hundred times within a microsecond of such work.
constexpr std::uint64_t kAllocationsOfResource = 2'000;

constexpr int kMegabytes = 800;

/// A copy of the process must not be made while another thread holds a lock within Z3: queries in this process share
/// the gate, the making of a copy has it alone.
std::shared_mutex &gate() {
  static std::shared_mutex mutex;
  return mutex;
}

std::string valueText(const z3::expr &value) {
  if (value.is_bool())
    return value.is_true() ? "true" : "false";
  if (value.is_algebraic()) {
    z3::expr lower(value.ctx(), Z3_get_algebraic_number_lower(value.ctx(), value, 20));
    return Z3_get_numeral_string(value.ctx(), lower);
  }
  return value.is_numeral() ? Z3_get_numeral_string(value.ctx(), value) : "";
}

std::string modelText(const z3::model &model) {
  std::string text;
  for (unsigned index = 0; index < model.num_consts(); ++index) {
    const z3::func_decl constant = model.get_const_decl(index);
    const std::string value = valueText(model.get_const_interp(constant));
    if (!value.empty())
      text += " (" + quotedSymbol(constant.name().str()) + " " + value + ")";
  }
  return text;
}

/// One of the statistics of Z3 that is a count.
std::uint64_t countOf(const z3::solver &solver, std::string_view name) {
  const z3::stats statistics = solver.statistics();
  for (unsigned index = 0; index < statistics.size(); ++index)
    if (statistics.key(index) == name)
      return statistics.is_uint(index) ? statistics.uint_value(index)
                                       : static_cast<std::uint64_t>(statistics.double_value(index));
  return 0;
}

/// From here on in this process, whose counter cannot go farther than an unsigned number.
void limitAllocations(std::uint64_t most) {
  z3::context context;
  const std::uint64_t before = countOf(z3::solver(context), "num allocs");
  const std::uint64_t largest = std::numeric_limits<unsigned>::max();
  if (before < largest)
    z3::set_param("memory_max_alloc_count", std::to_string(std::min(before + most, largest)).c_str());
}

z3::solver solverFor(z3::context &context, const std::string &smtlib, Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::Linear)
    return z3::solver(context, z3::solver::simple());
  // nlsat is complete on reals alone; the general solver is better with integers beside them.
  if (smtlib.starts_with("(set-logic QF_NRA)"))
    return z3::solver(context, "QF_NRA");
  return z3::solver(context);
}

/// `(sat 1234 (x 3/4))`, `(unsat 1234)`, `(unknown 1234 |why|)`
std::string solve(const std::string &smtlib, Arithmetic arithmetic, std::uint64_t resources) {
  try {
    z3::context context;
    z3::solver solver = solverFor(context, smtlib, arithmetic);
    z3::params parameters(context);
    const std::uint64_t most = std::numeric_limits<unsigned>::max();
    parameters.set("rlimit", static_cast<unsigned>(resources < most ? resources : most));
    solver.set(parameters);
    solver.add(context.parse_string(smtlib.c_str()));
    const z3::check_result result = solver.check();
    const std::string effort = " " + std::to_string(countOf(solver, "rlimit count"));
    switch (result) {
    case z3::sat: return "(sat" + effort + modelText(solver.get_model()) + ")";
    case z3::unsat: return "(unsat" + effort + ")";
    case z3::unknown: return "(unknown" + effort + " " + quotedSymbol(solver.reason_unknown()) + ")";
    }
    return "";
  } catch (const z3::exception &problem) {
    return "(unknown 0 " + quotedSymbol(problem.msg()) + ")";
  }
}

/// Bytes of a question that is put in this process.  The simplex of Z3 does not count what its numbers cost: with many
/// rows it may go on for minutes within its budget.
constexpr std::size_t kLargestHere = 8'000;

NoAnswer noAnswer(const std::string &reason) { return {"Z3 gave no answer: " + reason}; }

Answer readAnswer(const std::string &text) {
  Result<std::vector<SExpression>> read = readSExpressions(text);
  if (!read || read.value().size() != 1 || read.value()[0].items.size() < 2)
    return {noAnswer("its process failed")};
  const std::vector<SExpression> &items = read.value()[0].items;
  Answer answer{NoAnswer{}, 0};
  if (std::optional<Number> effort = Number::parse(items[1].atom))
    answer.effort = static_cast<std::uint64_t>(effort->toDouble());
  if (items[0].isAtom("unsat")) {
    answer.result = Unsat{};
  } else if (items[0].isAtom("sat")) {
    Sat sat;
    for (std::size_t index = 2; index < items.size(); ++index) {
      const SExpression &value = items[index].items[1];
      if (value.isAtom("true") || value.isAtom("false"))
        sat.model.emplace(items[index].items[0].atom, value.isAtom("true"));
      else if (std::optional<Number> number = Number::parse(value.atom))
        sat.model.emplace(items[index].items[0].atom, *number);
    }
    answer.result = std::move(sat);
  } else {
    answer.result = noAnswer(items.size() > 2 ? items[2].atom : "");
  }
  return answer;
}

} // namespace

Answer askZ3(const std::string &smtlib, Arithmetic arithmetic, std::uint64_t resources) {
  if (arithmetic == Arithmetic::Linear && smtlib.size() < kLargestHere) {
    std::shared_lock shared(gate());
    return readAnswer(solve(smtlib, arithmetic, resources));
  }
  auto inTheChild = [&] {
    z3::set_param("memory_max_size", kMegabytes);
    limitAllocations(kAllocationsOfResource * resources);
    return solve(smtlib, arithmetic, resources);
  };
  Result<ProcessOutput> output = runInChild(inTheChild, limitsFor(resources), gate());
  if (!output)
    return {noAnswer(output.error().message)};
  // The same effort, whichever comes first: a slow machine is stopped by the clock where a fast one comes to the limit
  // of memory, and what is left for the next questions must not depend on that.
  if (output.value().end == ProcessOutput::End::Killed)
    return {noAnswer("it did not obey its budget and was stopped"), resources};
  if (output.value().exitCode != 0)
    return {noAnswer("it takes more memory than goes with its budget"), resources};
  return readAnswer(output.value().output);
}

std::optional<std::string> z3Version() {
  unsigned major = 0, minor = 0, build = 0, revision = 0;
  Z3_get_version(&major, &minor, &build, &revision);
  return "z3 " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

} // namespace feedhold::smt
