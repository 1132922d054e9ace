// copied-block: `#101=#5041`, `#102=#5042`, `#102=#5043`: the row of variables breaks off in one of the blocks.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::copied_block {
namespace {

/// A number of a variable or a letter of an axis, which is counted up from block to block.
struct Part {
  std::int64_t value;
  Span span;
};

/// The text of a block without blanks, comments and its sequence number: what stays the same, and what is counted up.
struct Shape {
  std::string text;
  std::vector<Part> parts;
};

bool isAxis(char letter) { return std::string_view("UVWXYZIJK").find(letter) != std::string_view::npos; }

class ShapeReader {
public:
  ShapeReader(const FileContext &context, BlockId block) : context_(context), block_(context.tree.blocks[block]) {
    for (const Word &word : context.tree.wordsOf(block))
      if (word.address() == 'N')
        leftOut_.push_back(word.span());
    for (const Comment &comment : context.tree.commentsOf(block))
      leftOut_.push_back(comment.span);
  }

  Shape read() {
    for (at_ = block_.begin; at_ < block_.end;) {
      const auto out = std::ranges::find_if(leftOut_, [&](const Span &span) { return span.begin == at_; });
      if (out != leftOut_.end())
        at_ = out->end;
      else
        readOne();
    }
    return std::move(shape_);
  }

private:
  char here() const { return at_ < block_.end ? toUpper(context_.text({at_, at_ + 1}).front()) : ' '; }
  static bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }

  void readOne() {
    const char c = here();
    if (isLetter(c))
      return readLetters();
    if (isDigit(c) || c == '.')
      return readNumber();
    if (!isBlank(c))
      shape_.text.push_back(c);
    ++at_;
  }
  /// Two and more letters are a function or an operator.
  void readLetters() {
    const std::uint32_t begin = at_;
    std::string letters;
    for (; isLetter(here()); ++at_)
      letters.push_back(here());
    if (letters.size() > 1 || !isAxis(letters.front())) {
      shape_.text += letters;
      return;
    }
    shape_.text.push_back('@');
    shape_.parts.push_back({letters.front(), {begin, at_}});
  }
  /// `#101`; of `#[5221+#3]`, the number of the table; other numbers may be any.
  void readNumber() {
    const std::uint32_t begin = at_;
    while (isDigit(here()) || here() == '.')
      ++at_;
    const std::string_view text = context_.text({begin, at_});
    const bool isVariable = shape_.text.ends_with('#') || shape_.text.ends_with("#[");
    std::int64_t value = 0;
    for (const char c : text)
      value = isDigit(c) && value < 10'000'000 ? value * 10 + (c - '0') : value;
    // Codes are part of the shape: G00 is not G01.
    const bool isCode = shape_.text.ends_with('G') || shape_.text.ends_with('M');
    shape_.text += isCode ? std::string(text) : "n";
    const bool isNumbered = begin > block_.begin && context_.text({begin - 1, begin}) == "#";
    if (isVariable && text.find('.') == std::string_view::npos)
      shape_.parts.push_back({value, {isNumbered ? begin - 1 : begin, at_}});
  }

  const FileContext &context_;
  const Block &block_;
  std::vector<Span> leftOut_;
  std::uint32_t at_ = 0;
  Shape shape_;
};

/// Two alike show no order.
constexpr std::size_t kFewestBlocks = 3;

/// How one part runs through the blocks.
struct Course {
  enum Kind { Same, CountedUp, Repeated, Mistyped, Other } kind = Other;
  std::size_t where = 0; // of Repeated, Mistyped
  std::int64_t expected = 0;
};

/// `#502` for `#512`: one digit was not changed, or mistyped, and not the one that is counted up.
bool isMistyped(std::int64_t value, std::int64_t expected) {
  constexpr std::int64_t kThreeDigits = 100;
  if (value < kThreeDigits || expected < kThreeDigits || value % 10 != expected % 10)
    return false;
  int differing = 0;
  for (; value > 0 && expected > 0; value /= 10, expected /= 10)
    differing += value % 10 != expected % 10 ? 1 : 0;
  return differing == 1 && value == expected;
}

/// Same and counted up by one number; or so in all blocks but one, which repeats the value of an earlier one or differs
/// in one digit.
Course courseOf(const std::vector<std::int64_t> &values) {
  if (values.size() < kFewestBlocks)
    return {};
  const auto fits = [&](std::int64_t step, std::size_t base, std::size_t but) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (i != but &&
          values[i] - values[base] != step * (static_cast<std::int64_t>(i) - static_cast<std::int64_t>(base)))
        return false;
    return true;
  };
  const std::size_t none = values.size();
  const std::int64_t step = values[1] - values[0];
  if (fits(step, 0, none))
    return {step == 0 ? Course::Same : Course::CountedUp};
  for (std::size_t but = 1; but < values.size(); ++but) {
    const std::size_t last = but + 1 == values.size() ? but - 1 : values.size() - 1;
    const auto distance = std::max<std::int64_t>(1, static_cast<std::int64_t>(last));
    const std::int64_t each = (values[last] - values[0]) / distance;
    const auto before = values.begin() + static_cast<std::ptrdiff_t>(but);
    const std::int64_t expected = values[0] + each * static_cast<std::int64_t>(but);
    if (each == 0 || !fits(each, 0, but))
      continue;
    if (std::find(values.begin(), before, values[but]) != before)
      return {Course::Repeated, but, expected};
    if (each == 1 && isMistyped(values[but], expected))
      return {Course::Mistyped, but, expected};
  }
  return {};
}

struct Slip {
  std::size_t block;
  std::size_t part;
  std::int64_t expected;
  bool isMistyped;
};

constexpr std::int64_t kFirstSystemVariable = 1000;

/// `IF[#9EQ#0]THEN#8=50.`: in the other blocks the variable is the one that another part names.
bool isElsewhereEqual(const std::vector<Shape> &row, const Slip &slip) {
  for (std::size_t part = 0; part < row.front().parts.size(); ++part) {
    const auto follows = [&](const Shape &shape) {
      const bool isSlip = &shape == &row[slip.block];
      return shape.parts[part].value == (isSlip ? slip.expected : shape.parts[slip.part].value);
    };
    if (part != slip.part && std::ranges::all_of(row, follows))
      return true;
  }
  return false;
}

/// All parts run evenly through the row but those of one block; enough of them are counted up to tell what was meant.
std::optional<Slip> slipIn(const std::vector<Shape> &row) {
  std::optional<Slip> slip;
  std::size_t counted = 0;
  for (std::size_t part = 0; part < row.front().parts.size(); ++part) {
    std::vector<std::int64_t> values;
    for (const Shape &shape : row)
      values.push_back(shape.parts[part].value);
    const Course course = courseOf(values);
    const bool isBroken = course.kind == Course::Repeated || course.kind == Course::Mistyped;
    if (course.kind == Course::Other || (isBroken && slip))
      return std::nullopt;
    if (isBroken)
      slip = Slip{course.where, part, course.expected, course.kind == Course::Mistyped};
    counted += course.kind == Course::CountedUp ? 1 : 0;
  }
  if (!slip)
    return std::nullopt;
  const Shape &where = row[slip->block];
  // A variable that is set twice in a row loses its first value; tables of the control are read in order.
  const bool isClear = (slip->part == 0 && where.text.starts_with("#n=")) ||
                       where.parts[slip->part].value >= kFirstSystemVariable || isElsewhereEqual(row, *slip);
  return counted >= (row.size() == kFewestBlocks && !isClear ? 2U : 1U) ? slip : std::nullopt;
}

std::string spelled(const FileContext &context, const Part &part, std::int64_t value) {
  const char first = toUpper(context.text(part.span).front());
  return isAxis(first) ? std::string(1, static_cast<char>(value)) : fmt::format("{}{}", first == '#' ? "#" : "", value);
}

void tell(const std::vector<Shape> &row, const Slip &slip, const FileContext &context, const Reporter &reporter) {
  const Part &part = row[slip.block].parts[slip.part];
  Diagnostic diagnostic{.message = fmt::format("{} breaks the row of these blocks: `{}` would continue it",
                                               context.quoted(part.span), spelled(context, part, slip.expected)),
                        .span = part.span,
                        .notes = {"the other variables and axes of these blocks are counted up: the block was "
                                  "probably copied, and this one not changed",
                                  "correct it, or say in a comment why it differs"}};
  for (std::size_t i = 0; i < row.size(); ++i)
    if (i != slip.block)
      diagnostic.labels.push_back({row[i].parts[slip.part].span, ""});
  reporter.report(std::move(diagnostic));
}

/// Rows that stand one below the other without anything between: `#501=#5221` .. `#503=#5223`, `#511=#5241` .. Where
/// some part is counted up by one in each, they end where it starts anew.
std::vector<std::vector<Shape>> splitRows(const std::vector<Shape> &row) {
  for (std::size_t part = 0; part < row.front().parts.size(); ++part) {
    std::vector<std::vector<Shape>> rows;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == 0 || row[i].parts[part].value != row[i - 1].parts[part].value + 1)
        rows.emplace_back();
      rows.back().push_back(row[i]);
    }
    const auto isLong = [](const std::vector<Shape> &each) { return each.size() >= kFewestBlocks; };
    if (rows.size() > 1 && std::ranges::all_of(rows, isLong))
      return rows;
  }
  return {};
}

bool isWhole(const FileContext &context, BlockId block) {
  const Block &its = context.tree.blocks[block];
  return !its.has(Block::kBroken) && !its.has(Block::kLeader) && !its.has(Block::kAfterEnd) && !its.has(Block::kSkip);
}

/// Consecutive blocks of one shape; longer rows are tables.
constexpr std::size_t kMostBlocks = 12;

/// A name that nothing else in the program has was not meant: the odd one is a name of its own.
bool isKnown(const Slip &slip, ProgramId program, const FileContext &context) {
  return !slip.isMistyped || slip.expected >= kFirstSystemVariable ||
         std::ranges::any_of(context.model.variablesOf(program), [&](const VariableUse &use) {
           return use.number && static_cast<std::int64_t>(*use.number) == slip.expected;
         });
}

/// The slip of the row, or of the rows of which it consists.
void checkRow(const std::vector<Shape> &row, ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (row.size() < kFewestBlocks || row.size() > kMostBlocks)
    return;
  for (const auto &each : slipIn(row) ? std::vector<std::vector<Shape>>{row} : splitRows(row))
    if (const auto found = slipIn(each); found && isKnown(*found, program, context))
      tell(each, *found, context, reporter);
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  std::vector<Shape> row;
  const auto close = [&] {
    checkRow(row, id, context, reporter);
    row.clear();
  };
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    Shape shape = isWhole(context, block) ? ShapeReader(context, block).read() : Shape{};
    if (shape.parts.empty() || (!row.empty() && shape.text != row.front().text))
      close();
    if (shape.parts.empty())
      continue;
    row.push_back(std::move(shape));
  }
  close();
}

} // namespace

extern const Rule copiedBlock;
const Rule copiedBlock{
    .info = {"copied-block", Category::Expression, Severity::Warning,
             "Reports a row of parallel blocks of which one repeats the variable or axis of another."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::copied_block
