#include "proof/replay/start_inputs.h"

#include "proof/replay/exact_run.h"

#include <algorithm>
#include <cmath>

namespace feedhold::prove {

using smt::TermId;

namespace {

bool isVariable(const smt::TermStore &store, TermId term) { return store[term].kind == smt::TermKind::Variable; }

/// The number that a model gives a variable; absent: it names none that a double can hold.
std::optional<double> numberIn(const smt::TermStore &store, const smt::Model &model, TermId variable) {
  const auto named = model.find(store[variable].name);
  if (named == model.end())
    return std::nullopt;
  const double value = std::get<smt::Number>(named->second).toDouble();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The numbers of tools and offsets are whole; all words have at most eight digits.
bool canBeInForce(char letter, double number) {
  return number >= 0 && number <= 99'999'999 && (letter == 'F' || number == std::floor(number));
}

/// To the least increment in millimetres, without -0.
double toIncrement(double coordinate) { return std::round(coordinate * 1000) / 1000 + 0.0; }
bool canBeReached(double coordinate) { return std::fabs(coordinate) < 100'000; }

CodeMask wholeModes(const Dialect &dialect, const ModalGroup &group) {
  CodeMask mask = 0;
  for (std::size_t i = 0; i < group.codes.size(); ++i)
    if (isWholeMode(group.codes[i]->action) && !isBuildersCode(dialect, 'G', group.codes[i]->tenths))
      mask |= CodeMask{1} << i;
  return mask;
}

} // namespace

StartInputs::StartInputs(const smt::TermStore &store, const Dialect &dialect, const SymbolicState &entry,
                         const std::map<Axis, TermId> &place) {
  const ModalTable modes(dialect);
  for (std::uint8_t group = 1; group < kModalGroups; ++group)
    if (modes.powerOn(group) && isVariable(store, entry.codes[group].index))
      codes_.push_back({group, entry.codes[group].index, *modes.powerOn(group), wholeModes(dialect, modes.group(group)),
                        group == modes.groupOf(ModalKind::Plane) || group == modes.groupOf(ModalKind::Distance)});
  for (const char letter : kGivenWords)
    if (const SymbolicValue &word = entry.word(letter); isVariable(store, word.number))
      words_.emplace_back(letter, word);
  for (const Axis axis : kAllAxes)
    if (const TermId at = entry.at(axis).number; isVariable(store, at) && !place.contains(axis))
      place_.emplace_back(axis, at);
}

GivenStart StartInputs::startOf(const smt::TermStore &store, const smt::Model &model) const {
  GivenStart start;
  for (const Code &code : codes_) {
    const auto number = numberIn(store, model, code.index);
    if (!number || *number < 0 || *number >= 64)
      continue;
    const auto index = static_cast<std::uint8_t>(*number);
    if ((code.whole >> index & 1) != 0 && index != code.powerOn)
      start.codes.emplace_back(code.group, index);
  }
  for (const auto &[letter, word] : words_) {
    const auto vacant = isVariable(store, word.vacant) ? model.find(store[word.vacant].name) : model.end();
    const auto number = numberIn(store, model, word.number);
    const bool isVacant = vacant == model.end() ? !number : std::get<bool>(vacant->second);
    if (!isVacant && canBeInForce(letter, number.value_or(0)))
      start.words.emplace_back(letter, number.value_or(0));
  }
  for (const auto &[axis, at] : place_)
    if (const double coordinate = toIncrement(numberIn(store, model, at).value_or(0));
        coordinate != 0 && canBeReached(coordinate))
      start.place.emplace_back(axis, coordinate);
  const auto names = switchNames();
  for (SwitchId id = 0; id < names.size(); ++id)
    if (std::ranges::any_of(model, [&](const auto &named) {
          return named.first.starts_with(nameOfSetting(id)) && std::get<bool>(named.second) != names[id].usual;
        }))
      start.settings.emplace_back(id, !names[id].usual);
  return start;
}

std::vector<GivenStart> StartInputs::otherModes() const {
  std::vector<GivenStart> starts;
  for (const Code &code : codes_)
    for (std::uint8_t index = 0; index < 64 && code.isSampled; ++index)
      if ((code.whole >> index & 1) != 0 && index != code.powerOn)
        starts.push_back({.codes = {{code.group, index}}});
  return starts;
}

void StartInputs::addTo(SymbolicInterpretation &interpretation, smt::Model &model, const GivenStart &start) const {
  const smt::TermStore &store = interpretation.store();
  const auto found = [](const auto &list, auto key) {
    const auto at = std::ranges::find(list, key, [](const auto &entry) { return entry.first; });
    return at == list.end() ? std::nullopt : std::optional(at->second);
  };
  for (const Code &code : codes_)
    model[store[code.index].name] =
        smt::Number(static_cast<int>(found(start.codes, code.group).value_or(code.powerOn)));
  for (const auto &[letter, word] : words_) {
    const auto given = found(start.words, letter);
    model[store[word.number].name] = inputNumber(interpretation, given.value_or(0));
    if (isVariable(store, word.vacant))
      model[store[word.vacant].name] = !given;
  }
  for (const auto &[axis, at] : place_)
    model[store[at].name] = inputNumber(interpretation, found(start.place, axis).value_or(0));
  const auto names = switchNames();
  for (const auto &[id, asked] : interpretation.askedSettings())
    model[store[asked].name] = found(start.settings, id).value_or(names[id].usual);
}

void setStart(SymbolicInterpretation &interpretation, SymbolicState &entry, const GivenStart &start) {
  smt::TermStore &store = interpretation.store();
  const auto typed = [&](double number) { return store.number(inputNumber(interpretation, number)); };
  for (const auto &[group, code] : start.codes)
    entry.codes[group] = interpretation.code(code);
  for (const auto &[letter, number] : start.words)
    entry.word(letter) = {store.no(), typed(number)};
  for (const auto &[axis, coordinate] : start.place)
    entry.at(axis) = {store.no(), typed(coordinate)};
}

std::vector<GivenStart> plainerStarts(const GivenStart &start) {
  std::vector<GivenStart> plainer;
  if (start.isEmpty())
    return plainer;
  plainer.emplace_back();
  const auto withoutEach = [&](auto GivenStart::*list) {
    for (std::size_t i = 0; i < (start.*list).size(); ++i) {
      plainer.push_back(start);
      (plainer.back().*list).erase((plainer.back().*list).begin() + static_cast<std::ptrdiff_t>(i));
    }
  };
  const auto wholeEach = [&](auto GivenStart::*list) {
    for (std::size_t i = 0; i < (start.*list).size(); ++i)
      for (const double plain : {1.0, 10.0, std::round((start.*list)[i].second)})
        if (plain != 0 && std::fabs(plain) < std::fabs((start.*list)[i].second)) {
          plainer.push_back(start);
          (plainer.back().*list)[i].second = plain;
        }
  };
  withoutEach(&GivenStart::codes);
  withoutEach(&GivenStart::words);
  withoutEach(&GivenStart::place);
  withoutEach(&GivenStart::settings);
  wholeEach(&GivenStart::words);
  wholeEach(&GivenStart::place);
  return plainer;
}

} // namespace feedhold::prove
