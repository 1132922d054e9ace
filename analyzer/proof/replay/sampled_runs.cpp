// The part of WitnessSearch that chooses runs: likely calls, plain numbers, ends of ranges, and variants of runs that
// came farther than others.
#include "proof/decide/cancel.h"
#include "proof/replay/witness.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedhold::prove {

namespace {

constexpr int kSamples = 150;
constexpr std::size_t kFewSamples = 30;
constexpr int kSamplesOfEnds = 50;
constexpr int kSamplesOfDecimals = 60;
constexpr int kVariants = 400;
constexpr int kAcceptedVariants = 8; // of them, the first: calls that guards let pass
constexpr int kIdleVariants = 120;   // that end as others before the search stops

/// To a multiple of 1 / scale.
double rounded(double value, double scale) { return std::round(value * scale) / scale + 0.0; } // no -0

} // namespace

std::vector<double> WitnessSearch::plainNumbers() const {
  std::vector<double> plain{0, 1, -1, 2, 5, 10, 0.5, -10, 100};
  for (const double constant : constants_)
    plain.insert(plain.end(), {constant, constant + 1, constant - 1, 0.0 - constant}); // no -0
  return plain;
}

void WitnessSearch::sample() {
  const std::vector<double> pool = plainNumbers();
  std::mt19937 random(1);
  const std::vector<std::uint32_t> names = inputs();
  for (const GivenVariables &call : likely_->calls())
    keepSample(readBy(call));
  firstPlain_ = samples_.size();
  for (int i = 0; i < kSamples; ++i) {
    GivenVariables given;
    for (const std::uint32_t variable : names) {
      const auto choice = random() % (pool.size() + pool.size() / 4 + 1);
      if (i > 0 && choice < pool.size())
        given.set(variable, ConcreteValue::of(pool[choice]));
    }
    keepSample(std::move(given));
  }
  sampleOffsets();
}

std::vector<std::uint32_t> WitnessSearch::offsetsNamed() const {
  constexpr std::size_t kMostOffsets = 3;
  const ProgramFile &file = programs_.file(entry_.file);
  const OffsetMemory &memory = file.dialect->behaviour.cutterOffsets;
  std::vector<std::uint32_t> cells;
  for (const Word &word : file.tree->words) {
    const std::uint32_t number = word.address() == 'D' ? word.integer().value_or(0) : 0;
    if (number == 0 || number > memory.count)
      continue;
    const std::uint32_t cell = cellOf(*file.dialect, memory.geometry.front() + number - 1);
    if (std::ranges::find(cells, cell) == cells.end() && cells.size() < kMostOffsets)
      cells.push_back(cell);
  }
  return cells;
}

/// Without a word of the contract on the tool: radii as they stand in tool tables, the same for all offsets.
void WitnessSearch::sampleOffsets() {
  constexpr std::size_t kBases = 2; // calls
  const std::vector<std::uint32_t> cells = offsetsNamed();
  if (start_.cutterRadius || cells.empty())
    return;
  const std::size_t known = std::min(samples_.size(), kBases);
  for (std::size_t i = 0; i < known; ++i)
    for (const double radius : {0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.5, 16.0, 25.0, 40.0, 63.0}) {
      GivenVariables given = samples_[i].given;
      for (const std::uint32_t cell : cells)
        given.set(cell, ConcreteValue::of(radius));
      keepSample(std::move(given));
    }
}

std::optional<std::uint32_t> WitnessSearch::offsetCell(double number) const {
  const Dialect &dialect = *programs_.file(entry_.file).dialect;
  const OffsetMemory &memory = dialect.behaviour.cutterOffsets;
  if (!(number >= 1 && number <= memory.count) || number != std::floor(number))
    return std::nullopt;
  return cellOf(dialect, memory.geometry.front() + static_cast<std::uint32_t>(number) - 1);
}

/// Where the setting says so, the register holds the diameter (parameter 5004#2, ODI).
ConcreteValue WitnessSearch::inRegister(double radius) const {
  const bool isDiameter = programs_.file(entry_.file).dialect->switches.odi == Switch::On;
  return ConcreteValue::of(isDiameter ? 2 * radius : radius);
}

void WitnessSearch::sampleOffsetEnds(const std::vector<OffsetEnd> &ends) {
  constexpr std::size_t kBases = 12; // calls
  const std::size_t known = ends.empty() ? 0 : samples_.size();
  for (std::size_t base = 0; base < std::min(known, kBases); ++base) {
    GivenVariables given = samples_[base * known / std::min(known, kBases)].given;
    for (const OffsetEnd &end : ends) {
      const auto number = endIn(given, end.number), radius = endIn(given, end.radius);
      const auto cell = number ? offsetCell(*number) : std::nullopt;
      const std::vector<std::uint32_t> cells =
          end.number ? (cell ? std::vector{*cell} : std::vector<std::uint32_t>()) : offsetsNamed();
      for (const std::uint32_t each : cells)
        if (radius)
          given.set(each, inRegister(*radius));
    }
    keepSample(std::move(given));
  }
}

void WitnessSearch::addOffsets(GivenVariables &given, const smt::Model &model) const {
  if (!offsets_)
    return;
  for (const auto &[number, radius] : offsets_(model))
    if (const auto cell = offsetCell(number); cell && !given.find(*cell))
      given.set(*cell, inRegister(radius));
}

void WitnessSearch::sampleSkips() {
  constexpr std::size_t kBases = 8; // runs
  constexpr double kStart = 0, kEnd = 1;
  static const std::vector<std::vector<double>> kShares = {{0.5},       {0.9},       {0.1},      {kStart},
                                                           {0.5, kEnd}, {kEnd, 0.5}, {0.9, 0.8}, {0.25, 0.75}};
  // With o-words (RS274NGC) #5070 says whether the signal has come, and a run reads it apart: it may contradict the
  // share.
  if (programs_.file(entry_.file).dialect->grammar.oWords)
    return;
  std::vector<std::size_t> bases;
  for (std::size_t i = 0; i < samples_.size() && bases.size() < kBases; ++i)
    if (samples_[i].result.skips > 0)
      bases.push_back(i);
  for (const std::size_t base : bases)
    for (const std::vector<double> &shares : kShares) {
      GivenVariables given = samples_[base].given;
      given.readings.set(kSkipShare, shares);
      keepSample(std::move(given));
    }
}

/// Of a call, what the program reads.
GivenVariables WitnessSearch::readBy(const GivenVariables &call) const {
  GivenVariables given;
  for (const auto &[variable, value] : call.entries())
    if (interpretation_.entryValues().contains(variable))
      given.set(variable, value);
  return given;
}

void WitnessSearch::sampleOtherModes() {
  constexpr std::size_t kSamplesOfMode = 12;
  const std::size_t known = std::min(samples_.size(), kSamplesOfMode);
  for (const GivenStart &start : open_.otherModes())
    for (std::size_t i = 0; i < known; ++i) {
      GivenVariables given = samples_[i].given;
      given.start = start;
      keepSample(std::move(given));
    }
}

void WitnessSearch::sampleAround(const smt::Model &allowed) {
  others_ = allowed;
  const std::vector<std::uint32_t> names = inputs();
  if (samples_.size() - firstPlain_ >= kFewSamples || names.empty())
    return;
  const std::vector<double> pool = plainNumbers();
  std::mt19937 random(1);
  GivenVariables given = inputsOf(allowed);
  keepSample(given);
  for (int i = 0; i < kSamples; ++i) {
    GivenVariables other = given;
    const std::uint32_t variable = names[random() % names.size()];
    const auto choice = random() % (pool.size() + pool.size() / 4 + 1);
    if (choice < pool.size())
      other.set(variable, ConcreteValue::of(pool[choice]));
    else
      other.erase(variable);
    if (!this->allowed(other))
      continue;
    keepSample(other);
    given = std::move(other);
  }
}

void WitnessSearch::sampleEnds(const std::vector<InputEnds> &ends) {
  std::mt19937 random(1);
  for (int i = 0; i < kSamplesOfEnds; ++i) {
    GivenVariables given = inputsOf(others_);
    for (const auto &[variable, low, high] : ends) {
      const auto least = endIn(given, low), most = endIn(given, high); // an end may depend on the inputs before
      const auto choice = i < 2 ? static_cast<unsigned>(i) : random() % 5;
      if (choice <= 1) {
        if (const auto end = choice == 0 ? least : most)
          given.set(variable, ConcreteValue::of(*end));
      } else if (choice == 2 && least && most) {
        given.set(variable, ConcreteValue::of(rounded((*least + *most) / 2, 1)));
      }
    }
    keepSample(std::move(given));
  }
}

std::optional<double> WitnessSearch::endIn(const GivenVariables &given, const std::optional<smt::TermId> &end) const {
  const auto exact = end ? smt::evaluate(interpretation_.store(), *end, modelOf(given)) : std::nullopt;
  const double value = exact ? std::get<smt::Number>(*exact).toDouble() : std::nan("");
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void WitnessSearch::sampleDecimals(const std::vector<InputEnds> &ends) {
  firstDecimal_ = samples_.size();
  std::mt19937 random(1);
  const auto share = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()); };
  const auto decimal = [&](double least, double most) {
    const double scale = std::pow(10.0, static_cast<double>(random() % 6));
    const double part = share();
    const double value = std::round((least + (most - least) * part * part * part) * scale) / scale; // mostly small ones
    return std::clamp(value, least, most);
  };
  for (int i = 0; i < kSamplesOfDecimals; ++i) {
    GivenVariables given = inputsOf(others_);
    for (const std::uint32_t variable : inputs()) {
      const auto known = std::ranges::find(ends, variable, &InputEnds::variable);
      const auto least = known == ends.end() ? std::nullopt : endIn(given, known->low);
      const auto most = known == ends.end() ? std::nullopt : endIn(given, known->high);
      if (ends.empty() || (least && most && *least <= *most))
        given.set(variable, ConcreteValue::of(decimal(least.value_or(0), most.value_or(30))));
    }
    keepSample(std::move(given));
  }
}

/// A search that is led by coverage, as fuzzers do it (M. Zalewski, American Fuzzy Lop): a run that comes to a new end,
/// or farther to a known one, has variants of its own.
void WitnessSearch::sampleVariants() {
  const std::vector<std::uint32_t> names = variables();
  if (names.empty() || samples_.empty())
    return;
  std::map<EndOfRun, std::size_t> parents; // of each end, the longest run
  const auto isFarther = [&](std::size_t sample) {
    const RunResult &run = samples_[sample].result;
    const auto [known, isNew] = parents.try_emplace(endOf(run), sample);
    if (isNew || run.steps <= samples_[known->second].result.steps)
      return isNew;
    known->second = sample;
    return true;
  };
  for (std::size_t i = 0; i < samples_.size(); ++i)
    isFarther(i);
  const std::vector<double> pool = plainNumbers();
  std::mt19937 random(1);
  for (int i = 0, idle = 0; i < kVariants && idle < kIdleVariants && !smt::areStepsUsedUp(); ++i, ++idle) {
    const std::size_t known = samples_.size();
    const std::size_t parent =
        std::next(parents.begin(), static_cast<std::ptrdiff_t>(random() % parents.size()))->second;
    keepSample(i < kAcceptedVariants ? likely_->accepted(random)
                                     : variantOf(samples_[parent].given, names, pool, random));
    if (samples_.size() > known && isFarther(known))
      idle = 0;
    else
      samples_.resize(known);
  }
}

/// With other values of an input or two; and often with a value for each input that has none.
GivenVariables WitnessSearch::variantOf(GivenVariables given, const std::vector<std::uint32_t> &names,
                                        const std::vector<double> &pool, std::mt19937 &random) {
  const auto anyOf = [&](const auto &values) { return values[random() % values.size()]; };
  if (random() % 3 == 0)
    for (const std::uint32_t name : names)
      if (given.find(name) == nullptr)
        given.set(name, ConcreteValue::of(anyOf(pool)));
  for (auto left = 1 + random() % 3; left > 0; --left) {
    const std::uint32_t name = anyOf(names);
    const ConcreteValue *same = given.find(anyOf(names));
    switch (random() % 8) {
    case 0: given.erase(name); break;
    case 1: given.set(name, same != nullptr ? *same : ConcreteValue::of(anyOf(pool))); break;
    case 2:
      given.set(name, ConcreteValue::of(static_cast<double>(random() % 2000) / 10 - 100));
      break; // few are special
    default: given.set(name, ConcreteValue::of(anyOf(pool))); break;
    }
  }
  return given;
}

std::set<std::uint32_t> WitnessSearch::inputsRead() const {
  std::set<std::uint32_t> read;
  for (const InputRead &each : interpretation_.inputReads())
    read.insert(each.variable);
  return read;
}

/// Of inputs that the program reads: at most so many of each.
void WitnessSearch::addReadings(GivenVariables &given, std::mt19937 &random, std::size_t most) const {
  const std::vector<double> pool = plainNumbers();
  for (const std::uint32_t variable : inputsRead()) {
    const VariableRange *range = findVariable(*programs_.file(entry_.file).dialect, variable);
    std::vector<double> script(1 + random() % most);
    if (programs_.isInputName(variable) && !given.find(variable))
      continue; // the machine does not give it
    if (readsAnything(variable)) {
      for (double &reading : script)
        reading = pool[random() % pool.size()];
      given.readings.set(variable, std::move(script));
      continue;
    }
    if (!range)
      continue;
    for (double &reading : script)
      reading = range->role == VariableRole::Signal ? static_cast<double>(random() % 2)
                                                    : std::fabs(pool[random() % pool.size()]);
    if (range->role == VariableRole::Clock)
      std::ranges::sort(script);
    if (!mayRead(*range, script))
      script = {std::floor(script.front())};
    given.readings.set(variable, std::move(script));
  }
}

std::vector<GivenVariables> WitnessSearch::smallInputs() const {
  constexpr std::size_t kMostInputs = 40;
  constexpr int kTries = 120;
  constexpr std::size_t kMostReadings = 16;
  constexpr std::array<unsigned, 3> kSizes = {4, 12, 30};
  std::vector<GivenVariables> found;
  std::mt19937 random(1);
  for (int i = 0; i < kTries && found.size() < kMostInputs && smt::stepsLeft() > 0; ++i) {
    GivenVariables given = inputsOf(others_);
    for (const std::uint32_t variable : inputs())
      given.set(variable, ConcreteValue::of(static_cast<double>(random() % kSizes[random() % kSizes.size()])));
    addReadings(given, random, kMostReadings);
    if (allowed(given))
      found.push_back(std::move(given));
  }
  return found;
}

void WitnessSearch::keepSample(GivenVariables given) {
  constexpr std::size_t kMostReadings = 4;
  if (samples_.size() % 2 != 0)
    addReadings(given, readings_, kMostReadings);
  if (smt::areStepsUsedUp() || !allowed(given))
    return;
  throwIfCancelled();
  keepRun(std::move(given));
}

void WitnessSearch::keepRun(GivenVariables given) {
  RunOptions options = runOptions(given);
  options.fuel = kSampleFuel;
  RunResult result = run(programs_, entry_, options);
  smt::spend(kStepsOfInstruction * result.steps);
  samples_.push_back({std::move(given), std::move(result)});
  breaking_.clear(); // it does not know this run
}

} // namespace feedhold::prove
