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
  enum Kind { Same, CountedUp, Broken, Other } kind = Other;
  std::size_t where = 0; // of Broken
  std::int64_t expected = 0;
};

/// Same and counted up by one number; or so in all blocks but one, which repeats the value of an earlier one.
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
    if (each != 0 && fits(each, 0, but) && std::find(values.begin(), before, values[but]) != before)
      return {Course::Broken, but, values[0] + each * static_cast<std::int64_t>(but)};
  }
  return {};
}

struct Slip {
  std::size_t block;
  std::size_t part;
  std::int64_t expected;
};

constexpr std::int64_t kFirstSystemVariable = 1000;

/// All parts run evenly through the row but those of one block; enough of them are counted up to tell what was meant.
std::optional<Slip> slipIn(const std::vector<Shape> &row) {
  std::optional<Slip> slip;
  std::size_t counted = 0;
  for (std::size_t part = 0; part < row.front().parts.size(); ++part) {
    std::vector<std::int64_t> values;
    for (const Shape &shape : row)
      values.push_back(shape.parts[part].value);
    const Course course = courseOf(values);
    if (course.kind == Course::Other || (course.kind == Course::Broken && slip))
      return std::nullopt;
    if (course.kind == Course::Broken)
      slip = Slip{course.where, part, course.expected};
    counted += course.kind == Course::CountedUp ? 1 : 0;
  }
  if (!slip)
    return std::nullopt;
  const Shape &where = row[slip->block];
  // A variable that is set twice in a row loses its first value; tables of the control are read in order.
  const bool isClear =
      (slip->part == 0 && where.text.starts_with("#n=")) || where.parts[slip->part].value >= kFirstSystemVariable;
  return counted >= (row.size() == kFewestBlocks && !isClear ? 2U : 1U) ? slip : std::nullopt;
}

std::string spelled(const FileContext &context, const Part &part, std::int64_t value) {
  const char first = toUpper(context.text(part.span).front());
  return isAxis(first) ? std::string(1, static_cast<char>(value)) : fmt::format("{}{}", first == '#' ? "#" : "", value);
}

void tell(const std::vector<Shape> &row, const FileContext &context, const Reporter &reporter) {
  const auto slip = slipIn(row);
  if (!slip)
    return;
  const Part &part = row[slip->block].parts[slip->part];
  Diagnostic diagnostic{.message = fmt::format("{} breaks the row of these blocks: `{}` would continue it",
                                               context.quoted(part.span), spelled(context, part, slip->expected)),
                        .span = part.span,
                        .notes = {"the other variables and axes of these blocks are counted up: the block was "
                                  "probably copied, and this one not changed",
                                  "correct it, or say in a comment why it differs"}};
  for (std::size_t i = 0; i < row.size(); ++i)
    if (i != slip->block)
      diagnostic.labels.push_back({row[i].parts[slip->part].span, ""});
  reporter.report(std::move(diagnostic));
}

bool isWhole(const FileContext &context, BlockId block) {
  const Block &its = context.tree.blocks[block];
  return !its.has(Block::kBroken) && !its.has(Block::kLeader) && !its.has(Block::kAfterEnd) && !its.has(Block::kSkip);
}

/// Consecutive blocks of one shape; longer rows are tables.
constexpr std::size_t kMostBlocks = 12;

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  std::vector<Shape> row;
  const auto close = [&] {
    if (row.size() >= kFewestBlocks && row.size() <= kMostBlocks)
      tell(row, context, reporter);
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
