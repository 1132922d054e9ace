// remark-of-other-code: `G90 (CHANGE TO INCREMENTAL)`.
#include "rules/comments/remarks_of_block.h"

#include <fmt/format.h>

#include <array>
#include <span>

namespace feedhold::rules::remark_of_other_code {
namespace {

/// Two codes that exclude each other, and words of which only one belongs to each.
struct Pair {
  std::string_view code, other;
  std::string_view own, others;  // as words with a blank around each
  std::string_view subject = {}; // of which the remark has to name one
};

constexpr std::string_view kAbsolute = " ABSOLUTE ABS ABSOLUT ";
constexpr std::string_view kIncremental = " INCREMENTAL INCR INC INKREMENTAL RELATIVE ";
constexpr std::string_view kInch = " INCH INCHES IMPERIAL ";
constexpr std::string_view kMetric = " METRIC MILLIMETERS MILLIMETRES MM ";
constexpr std::string_view kForward = " CW CLOCKWISE FORWARD FWD ";
constexpr std::string_view kReverse = " CCW COUNTERCLOCKWISE ANTICLOCKWISE REVERSE ";
constexpr std::string_view kLeft = " LEFT LH ";
constexpr std::string_view kRight = " RIGHT RH ";
constexpr std::string_view kCompensation = " COMP COMPENSATION COMPENSATE CUTTERCOMP CRC TNRC ";
constexpr std::array kPairs = {
    Pair{"G90", "G91", kAbsolute, kIncremental},
    Pair{"G91", "G90", kIncremental, kAbsolute},
    Pair{"G20", "G21", kInch, kMetric},
    Pair{"G21", "G20", kMetric, kInch},
    Pair{"M03", "M04", kForward, kReverse},
    Pair{"M04", "M03", kReverse, kForward},
    Pair{"G41", "G42", kLeft, kRight, kCompensation},
    Pair{"G42", "G41", kRight, kLeft, kCompensation},
};
/// `(END OF INCREMENTAL)`, `(INCH OR METRIC)`, `(REVERSE IS M04)`: the remark says more than the name of a mode.
constexpr std::string_view kSaysMore =
    " OFF CANCEL END ENDS FROM BACK NOT NO INSTEAD EXIT LEAVE AFTER OR IF THEN WAS TAP THREAD TOOL AND WHEN UNTIL "
    "BEFORE COUNTER ANTI HAND ONLY OUTPUT POST FOR ";
constexpr std::string_view kSides = " LEFT RIGHT ";

/// The remarks as words in capitals with a blank around each; empty where there are numbers, which measure something.
std::string wordsOf(const FileContext &context, BlockId block) {
  std::string words = " ";
  for (const char c : remarksOf(context, block)) {
    if (isDigit(c))
      return "";
    if (isLetter(c))
      words += c;
    else if (words.back() != ' ')
      words += ' ';
  }
  return words;
}

/// A word of the remark is in the list.
bool hasAny(std::string_view remark, std::string_view list) {
  for (std::size_t begin = 0; begin + 1 < remark.size();) {
    const std::size_t end = remark.find(' ', begin + 1);
    if (list.find(remark.substr(begin, end - begin + 1)) != list.npos)
      return true;
    begin = end;
  }
  return false;
}

bool isCode(const Word &word, std::string_view code) {
  const std::int64_t number = (code[1] - '0') * 10 + (code[2] - '0');
  return word.address() == code[0] && word.isNumber() && word.number().asInteger() == number;
}

const Word *findCode(std::span<const Word> words, std::string_view code) {
  const auto found = std::ranges::find_if(words, [&](const Word &word) { return isCode(word, code); });
  return found == words.end() ? nullptr : &*found;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr std::ptrdiff_t kMostBlanks = 7; // of a remark of six words
  const auto comments = context.tree.commentsOf(block);
  if (comments.empty() || meansOwnWords(context.tree, block, context.dialect))
    return;
  const std::span<const Word> words = context.tree.wordsOf(block);
  for (const Pair &pair : kPairs) {
    const Word *code = findCode(words, pair.code);
    const bool isOfMill = pair.subject.empty(); // codes that lathes have for other things, or mean by other words
    if (code == nullptr || findCode(words, pair.other) || (isOfMill && context.dialect.machine != MachineKind::Milling))
      continue;
    const std::string remark = wordsOf(context, block);
    if (isOfMill ? hasAny(remark, kSides) : !hasAny(remark, pair.subject))
      continue;
    if (!hasAny(remark, pair.others) || hasAny(remark, pair.own) || hasAny(remark, kSaysMore) ||
        std::ranges::count(remark, ' ') > kMostBlanks)
      continue;
    reporter.report(
        {.message =
             fmt::format("{} is not what the remark says: that is `{}`", context.quoted(code->span()), pair.other),
         .span = code->span(),
         .labels = {{comments.front().span, "the remark"}},
         .notes = {fmt::format("write `{}`, or correct the remark: whoever reads the program at the machine "
                               "trusts it",
                               pair.other)}});
    return;
  }
}

} // namespace

extern const Rule remarkOfOtherCode;
const Rule remarkOfOtherCode{.info = {"remark-of-other-code", Category::Comment, Severity::Warning,
                                      "Reports a `G90`, `G91`, `G20`, `G21`, `G41`, `G42`, `M03` or `M04` whose "
                                      "remark names the opposite."},
                             .hooks = {.block = check}};

} // namespace feedhold::rules::remark_of_other_code
