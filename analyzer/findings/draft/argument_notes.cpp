// See the header.
#include "findings/draft/argument_notes.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::draft {

namespace {

constexpr std::size_t kLongestName = 24;
constexpr std::size_t kMostWords = 4;
constexpr std::size_t kMostValuesTold = 6;
constexpr std::array<std::string_view, 14> kFillers = {"THE", "OF", "A",  "AN",  "IS", "TO",   "FOR",
                                                       "IN",  "AS", "AT", "AND", "OR", "THIS", "FROM"};
constexpr std::array<std::string_view, 11> kReserved = {"IN",  "BY",  "OPTIONAL", "MM",  "INCH", "DEG",
                                                        "REV", "SEC", "INT",      "RPM", "IPM"};
/// What follows says more of what has been named: `LENGTH BETWEEN THE TOP AND THE FIRST ROW`.
constexpr std::array<std::string_view, 15> kPrepositions = {"OF",   "FROM",  "BETWEEN", "BEFORE", "BEHIND",
                                                            "FOR",  "IN",    "AT",      "TO",     "ON",
                                                            "WITH", "AFTER", "ABOVE",   "BELOW",  "UNTIL"};
/// How people write units, and how contracts do; the longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kUnits = {{{"MM/MIN", "MM/MIN"},
                                                                                   {"MM/REV", "MM/REV"},
                                                                                   {"INCH/MIN", "INCH/MIN"},
                                                                                   {"IN/MIN", "INCH/MIN"},
                                                                                   {"IPM", "INCH/MIN"},
                                                                                   {"IN/REV", "INCH/REV"},
                                                                                   {"IPR", "INCH/REV"},
                                                                                   {"RPM", "REV/MIN"},
                                                                                   {"RPMS", "REV/MIN"},
                                                                                   {"MM", "MM"},
                                                                                   {"INCH", "INCH"},
                                                                                   {"INCHES", "INCH"},
                                                                                   {"DEGREES", "DEG"},
                                                                                   {"DEGREE", "DEG"},
                                                                                   {"DEG", "DEG"},
                                                                                   {"SECONDS", "SEC"},
                                                                                   {"SEC", "SEC"}}};

template <typename List> bool isOneOf(const List &list, std::string_view word) {
  return std::ranges::find(list, word) != std::end(list);
}

std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words;
  bool isInside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool isHyphen = c == '-' && i + 1 < text.size() && isLetter(text[i + 1]); // `B-AXIS` is one word
    const bool isPart = isLetter(c) || isDigit(c) || (isInside && (c == '/' || isHyphen));
    if (isPart && !isInside)
      words.emplace_back();
    if (isPart)
      words.back() += toUpper(c);
    isInside = isPart;
  }
  return words;
}

std::string unitIn(const std::vector<std::string> &words) {
  for (const auto &[written, unit] : kUnits)
    if (isOneOf(words, written))
      return std::string(unit);
  return {};
}

/// The words of a name, as far as they are told.  `X LOCATION IF GIVEN`: a condition follows.
std::vector<std::string> wordsOfName(const std::vector<std::string> &words) {
  std::vector<std::string> named;
  for (const std::string &word : words) {
    if (word == "IF" || word == "WHEN")
      break;
    const bool isName = isLetter(word.front()) && !isOneOf(kReserved, word) && word.find('/') == std::string::npos;
    if (isName && (isOneOf(kPrepositions, word) || !isOneOf(kFillers, word)))
      named.push_back(word);
  }
  return named;
}

/// `X-WIDTH-RAW-STOCK`; where that is too long, the words before the first preposition.
std::string nameIn(const std::vector<std::string> &words) {
  const std::vector<std::string> named = wordsOfName(words);
  const auto isPreposition = [](const std::string &word) { return isOneOf(kPrepositions, word); };
  const auto joined = [&](auto end) {
    std::string name;
    std::size_t count = 0;
    for (auto word = named.begin(); word != end; ++word) {
      if (isOneOf(kFillers, *word))
        continue;
      if (++count > kMostWords || name.size() + word->size() + 1 > kLongestName)
        return std::pair(name, false);
      name += (name.empty() ? "" : "-") + *word;
    }
    return std::pair(name, true);
  };
  // Letters alone name nothing, `Z-K` neither; one may be the axis of what follows.
  if (std::ranges::none_of(named, [&](const std::string &word) {
        return word.size() > 1 && (word[1] != '-' || word.size() > 3) && !isPreposition(word);
      }))
    return {};
  const auto [whole, isWhole] = joined(named.end());
  if (isWhole)
    return whole;
  const auto [head, isHead] = joined(std::ranges::find_if(named, isPreposition));
  return isHead && !head.empty() ? head : whole;
}

/// Absent: the text is no description but a formula or a condition.
std::optional<ArgumentNote> noteIn(std::string_view text) {
  text = trimmed(text);
  const std::string_view clause = text.substr(0, text.find_first_of(",;:|(["));
  if (text.empty() || !isLetter(text.front()) || clause.find_first_of("#<>=*+") != std::string_view::npos)
    return std::nullopt;
  ArgumentNote note{.name = nameIn(wordsOf(clause)), .unit = unitIn(wordsOf(text))};
  return note.name.empty() ? std::nullopt : std::optional(note);
}

/// What stands behind `=`, `:` or a `-` with a blank before it: `B-AXIS` is one word.
std::optional<std::string_view> behindSeparator(std::string_view text) {
  if (text.starts_with('-'))
    return std::nullopt;
  text = trimmed(text);
  if (text.empty() || std::string_view("-=:").find(text.front()) == std::string_view::npos)
    return std::nullopt;
  return trimmed(text.substr(1));
}

class NoteReader {
public:
  NoteReader(const Project &project, ProgramId program) : project_(project), program_(program) {}

  ArgumentNotes read() {
    const ProjectFile &own = project_.file(FileId(0));
    const Program &program = own.model.programs[program_];
    const BlockId first = program_ == ProgramId(0) ? BlockId(0) : program.first;
    for (BlockId block = first; block < program.last; block = block.next())
      if (!own.tree.wordsOf(block).empty() || !own.tree.statementsOf(block).empty())
        before_ = block;
      else
        for (const Comment &comment : own.tree.commentsOf(block))
          inComment(own, comment);
    for (const auto &file : project_.files)
      for (BlockId block(0); block.index() < file->tree.blockCount(); block = block.next())
        behindAssignment(*file, block);
    notes_.merge(ofLetters_);
    return std::move(notes_);
  }

private:
  static std::string_view inner(const ProjectFile &file, const Comment &comment) {
    std::string_view text = file.source.text(comment.span);
    text.remove_prefix(text.starts_with('(') || text.starts_with(';') ? 1 : 0);
    text.remove_suffix(text.ends_with(')') ? 1 : 0);
    return trimmed(text);
  }

  void inComment(const ProjectFile &file, const Comment &comment) {
    const std::string_view text = inner(file, comment);
    if (text.starts_with('#'))
      return ofVariable(text.substr(1));
    if (text.empty() || text.front() < 'A' || text.front() > 'Z' || isOfMove(file, text.front()))
      return;
    const std::uint8_t variable = argumentVariable(*file.dialect, text.front());
    if (const auto said = behindSeparator(text.substr(1)); said && variable != 0)
      addTo(ofLetters_, variable, *said);
  }
  /// `G00X#4Y0` with `(Y: ORIGIN)` below it: the comment is about the word.
  bool isOfMove(const ProjectFile &file, char letter) const {
    if (!before_)
      return false;
    const auto words = file.tree.wordsOf(*before_);
    return std::ranges::any_of(words, [&](const Word &word) { return word.address() == letter; });
  }
  /// `18: R: RAW STOCK`
  void ofVariable(std::string_view text) {
    std::uint32_t number = 0;
    std::size_t digits = 0;
    for (; digits < text.size() && digits < 6 && isDigit(text[digits]); ++digits)
      number = number * 10 + static_cast<std::uint32_t>(text[digits] - '0');
    auto said = digits == 0 ? std::nullopt : behindSeparator(text.substr(digits));
    if (said && said->size() > 1 && isLetter(said->front()) && !isLetter((*said)[1]))
      if (const auto behindLetter = behindSeparator(said->substr(1)))
        said = behindLetter;
    if (said)
      add(number, *said);
  }
  /// `#501=12. (DIAMETER)`
  void behindAssignment(const ProjectFile &file, BlockId block) {
    const auto statements = file.tree.statementsOf(block);
    const auto comments = file.tree.commentsOf(block);
    if (statements.size() != 1 || comments.size() != 1)
      return;
    const auto *assignment = std::get_if<Assignment>(&statements.front().node);
    const auto target = assignment ? variableNumber(file.tree, assignment->target) : std::nullopt;
    if (!target || *target <= kLocalVariables || !literalValue(file.tree, assignment->value))
      return;
    std::string_view text = inner(file, comments.front());
    add(*target, text);
  }
  void add(std::uint32_t variable, std::string_view text) { addTo(notes_, variable, text); }
  static void addTo(ArgumentNotes &notes, std::uint32_t variable, std::string_view text) {
    if (const auto note = noteIn(text))
      notes.try_emplace(variable, *note); // what is said first
  }

  const Project &project_;
  ProgramId program_;
  std::optional<BlockId> before_; // the last block that is more than a comment
  ArgumentNotes notes_;           // of variables by their number
  ArgumentNotes ofLetters_;
};

} // namespace

ArgumentNotes argumentNotes(const Project &project, ProgramId program) { return NoteReader(project, program).read(); }

PassedArgument passedIn(const Project &project, ProgramId program, std::uint32_t variable) {
  PassedArgument passed;
  for (const CallGraph::Caller &caller : project.callGraph.callers({FileId(0), program})) {
    const ProjectFile &file = project.file(caller.file);
    const Call &call = file.model.calls[caller.call];
    ++passed.calls;
    const auto argument = std::ranges::find_if(call.arguments, [&](const Argument &each) {
      return each.variable == variable && each.role == ArgumentRole::Passed;
    });
    if (argument == call.arguments.end())
      continue;
    ++passed.passing;
    const Word &word = file.tree.words[argument->word];
    if (word.isNumber())
      passed.values.push_back(word.number());
    else
      passed.isComputedSomewhere = true;
  }
  std::ranges::sort(passed.values);
  passed.values.erase(std::unique(passed.values.begin(), passed.values.end()), passed.values.end());
  return passed;
}

std::string toldOf(const PassedArgument &passed) {
  if (passed.calls == 0)
    return {};
  std::string values;
  if (!passed.values.empty() && passed.values.size() <= kMostValuesTold) {
    for (const Decimal &value : passed.values)
      values += (values.empty() ? " " : ", ") + value.toString();
  } else if (!passed.values.empty()) {
    values = fmt::format(" {} to {}", passed.values.front().toString(), passed.values.back().toString());
  }
  return fmt::format("{} of {} call{} pass{} it{}{}", passed.passing, passed.calls, passed.calls == 1 ? "" : "s",
                     passed.calls == 1 ? "es" : "", values.empty() ? "" : ":", values);
}

std::optional<char> letterOf(const Dialect &dialect, std::uint32_t variable) {
  const auto found = std::ranges::find(dialect.argumentVariables, variable);
  if (variable == 0 || found == dialect.argumentVariables.end())
    return std::nullopt;
  return static_cast<char>('A' + (found - dialect.argumentVariables.begin()));
}

} // namespace feedhold::draft
