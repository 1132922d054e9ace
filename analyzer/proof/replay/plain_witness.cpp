// How a witness is made plain: like a call that a shop would make, and with no more than it needs.
#include "proof/replay/witness.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace feedhold::prove {

namespace {

constexpr std::size_t kMostTried = 12; // numbers for one input

/// To a multiple of 1 / scale.
double shortenedTo(double value, double scale) { return std::round(value * scale) / scale + 0.0; } // no -0

/// With another value of one input; absent: vacant.
GivenVariables with(GivenVariables given, std::uint32_t variable, std::optional<double> value) {
  if (value)
    given.set(variable, ConcreteValue::of(*value));
  else
    given.erase(variable);
  return given;
}

} // namespace

/// Each input in turn as near to a likely call as will do (likely_calls.h).
Witness WitnessSearch::plainest(Witness witness, const Violation &violation, std::uint64_t fuel) const {
  const std::vector<std::uint32_t> names = inputs();
  GivenVariables whole = witness.variables;
  const GivenVariables likely = likely_->completed(whole);
  for (const auto &[variable, value] : likely.entries())
    if (std::ranges::binary_search(names, variable))
      whole.set(variable, value);
  if (whole != witness.variables)
    if (auto found = tried(whole, violation, fuel))
      witness = *std::move(found);
  for (const std::uint32_t variable : names)
    for (const GivenVariables &given : nearer(witness.variables, variable))
      if (auto found = tried(given, violation, fuel)) {
        witness = std::move(*found);
        break;
      }
  return withPlainReadings(withPlainStart(std::move(witness), violation, fuel), violation, fuel);
}

/// The same inputs with another value of one of them, the nearest to a likely call first.
std::vector<GivenVariables> WitnessSearch::nearer(const GivenVariables &given, std::uint32_t variable) const {
  const ConcreteValue *held = given.find(variable);
  std::vector<std::optional<double>> values{std::nullopt};
  for (const double value : likely_->valuesOf(variable))
    values.emplace_back(value);
  if (held && !held->vacant) {
    values.insert(values.end(), {0.0, 1.0, -1.0, 10.0, 0.5, 1.5});
    for (const double scale : {0.1, 1.0, 10.0, 100.0, 1000.0})
      values.emplace_back(shortenedTo(held->number, scale));
  } else if (values.size() == 1) {
    return {};
  }
  std::vector<std::pair<unsigned, GivenVariables>> others;
  const unsigned present = likely_->distanceOf(given);
  std::set<std::optional<double>> known;
  for (const std::optional<double> &value : values) {
    GivenVariables other = with(given, variable, value);
    if (const unsigned distance = likely_->distanceOf(other); distance < present && known.insert(value).second)
      others.emplace_back(distance, std::move(other));
  }
  std::ranges::stable_sort(others, {}, [](const auto &each) { return each.first; });
  others.resize(std::min(others.size(), kMostTried));
  std::vector<GivenVariables> result;
  for (auto &[distance, other] : others)
    result.push_back(std::move(other));
  return result;
}

/// As after power-on if that will do; else in as few other codes, words and coordinates as will do.
Witness WitnessSearch::withPlainStart(Witness witness, const Violation &violation, std::uint64_t fuel) const {
  constexpr int kMostSteps = 12;
  const auto plainer = [&]() -> std::optional<Witness> {
    for (const GivenStart &start : plainerStarts(witness.variables.start)) {
      GivenVariables given = witness.variables;
      given.start = start;
      if (auto found = tried(given, violation, fuel))
        return found;
    }
    return std::nullopt;
  };
  for (int step = 0; step < kMostSteps; ++step) {
    auto found = plainer();
    if (!found)
      break;
    witness = *std::move(found);
  }
  return witness;
}

/// Each input in turn: without readings, that is 0; else as few numbers as will do, and 0 or 1 in place of others.
Witness WitnessSearch::withPlainReadings(Witness witness, const Violation &violation, std::uint64_t fuel) const {
  const auto taken = [&](std::uint32_t variable, const std::vector<double> &script) {
    GivenVariables given = witness.variables;
    given.readings.erase(variable);
    if (!script.empty())
      given.readings.set(variable, script);
    auto found = tried(given, violation, fuel);
    if (found)
      witness = *std::move(found);
    return found.has_value();
  };
  const InputReadings readings = witness.variables.readings;
  for (const auto &[variable, all] : readings.entries()) {
    if (taken(variable, {}) || variable == kSkipShare)
      continue;
    std::vector<double> script = all;
    for (std::size_t size = 1; size < script.size(); ++size)
      if (taken(variable, {script.begin(), script.begin() + static_cast<std::ptrdiff_t>(size)})) {
        script.resize(size);
        break;
      }
    for (double &reading : script) {
      const double before = reading;
      for (const double plain : {0.0, 1.0, shortenedTo(before, 1)}) {
        reading = plain;
        if (plain == before || taken(variable, script))
          break;
        reading = before;
      }
    }
  }
  return witness;
}

} // namespace feedhold::prove
