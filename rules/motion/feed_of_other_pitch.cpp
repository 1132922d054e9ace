// feed-of-other-pitch: `(TAP M8X1.25)`, `S500`, and then `G84 Z-20. F500.`
#include "rules/motion/tool_sections.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::rules::feed_of_other_pitch {
namespace {

constexpr double kInch = 25.4;
constexpr double kMost = 1.1; // a floating holder is fed a little slower, and numbers are rounded

struct Thread {
  double pitch; // in millimetres
  Span comment;
};

/// Reads one comment from the left.
class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  /// `M8X1.25`, `M8 - 1.25`; `1/4-20`, `10-32`, of a comment that says TAP.
  std::optional<double> pitch() {
    const bool isTap = hasWord("TAP");
    for (; at_ < text_.size(); ++at_) {
      if (at_ > 0 && (isLetter(text_[at_ - 1]) || isDigit(text_[at_ - 1]) || text_[at_ - 1] == '.'))
        continue;
      const std::size_t start = at_;
      const auto found = toUpper(text_[at_]) == 'M' ? metric() : isTap ? inch() : std::nullopt;
      if (found)
        return found;
      at_ = start;
    }
    return std::nullopt;
  }

private:
  bool hasWord(std::string_view word) const {
    std::string upper;
    for (const char each : text_)
      upper += toUpper(each);
    return upper.find(word) != std::string::npos;
  }
  void skipBlanks() {
    while (at_ < text_.size() && isBlank(text_[at_]))
      ++at_;
  }
  bool take(std::string_view any) {
    if (at_ >= text_.size() || any.find(toUpper(text_[at_])) == std::string_view::npos)
      return false;
    ++at_;
    return true;
  }
  std::optional<double> number() {
    std::string digits;
    for (; at_ < text_.size() && (isDigit(text_[at_]) || text_[at_] == '.'); ++at_)
      digits += text_[at_];
    return digits.empty() || digits == "." ? std::nullopt : std::optional(std::strtod(digits.c_str(), nullptr));
  }
  bool goesOn() const { return at_ < text_.size() && (isLetter(text_[at_]) || text_[at_] == '/'); }

  std::optional<double> metric() {
    constexpr double kCoarsest = 0.3; // of the diameter
    ++at_;
    const auto diameter = number();
    skipBlanks();
    if (!diameter || !take("X*-"))
      return std::nullopt;
    skipBlanks();
    const auto pitch = number();
    return pitch && !goesOn() && *pitch > 0.1 && *pitch < *diameter * kCoarsest ? pitch : std::nullopt;
  }
  std::optional<double> inch() {
    const auto size = number();
    if (size && take("/") && !number())
      return std::nullopt;
    const bool isThread = size && take("-");
    const auto count = isThread ? number() : std::nullopt;
    const bool isCount = count && *count >= 4 && *count <= 80 && *count == std::floor(*count);
    return isCount && (!goesOn() || toUpper(text_[at_]) == 'U') ? std::optional(kInch / *count) : std::nullopt;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

enum class FeedUnit : std::uint8_t { PerMinute, PerRevolution, Unknown };

/// What has been read of a tool when its cycle comes.
struct Tool {
  std::optional<Thread> thread;
  bool hasOtherThread = false;
  const Word *speed = nullptr;
  bool isHidden = false; // something may have changed unseen
};

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), hidden_(program, context), program_(context.model.programs[program]) {
    for (BlockId block = program_.first; block < program_.last; block = block.next()) {
      isInch_ = isInch_ || does(block, CodeAction::Inch);
      isMetric_ = isMetric_ || does(block, CodeAction::Metric);
    }
  }

  void read(const ToolSection &section, const Reporter &reporter) {
    Tool tool;
    noteThreads(headOf(section), section.first, tool);
    for (BlockId block = section.first; block < section.last; block = block.next()) {
      noteThreads(block, block.next(), tool);
      noteUnit(block);
      tool.isHidden = tool.isHidden || (block != section.first && hidden_.isIn(block));
      if (const Word *speed = findWord(context_.tree, block, 'S'))
        tool.speed = speed;
      const bool taps = does(block, CodeAction::CycleTap) || does(block, CodeAction::CycleTapLeft);
      if (taps && tool.thread && !tool.hasOtherThread && tool.speed && !tool.isHidden)
        judge(tool, block, reporter);
    }
  }
  void noteUnit(BlockId block) {
    if (does(block, CodeAction::FeedPerRevolution))
      unit_ = FeedUnit::PerRevolution;
    else if (does(block, CodeAction::FeedPerMinute))
      unit_ = FeedUnit::PerMinute;
    else if (does(block, CodeAction::FeedInverse))
      unit_ = FeedUnit::Unknown;
  }

private:
  bool does(BlockId block, CodeAction action) const {
    return findAction(context_.tree, block, context_.dialect, {action}) != nullptr;
  }
  /// From the remarks above the tool change.
  BlockId headOf(const ToolSection &section) const {
    BlockId head = section.first;
    while (head > program_.first && context_.tree.wordsOf(BlockId(head.index() - 1)).empty())
      head = BlockId(head.index() - 1);
    return head;
  }
  void noteThreads(BlockId first, BlockId last, Tool &tool) const {
    for (BlockId block = first; block < last; block = block.next())
      for (const Comment &comment : context_.tree.commentsOf(block))
        if (const auto pitch = Scanner(context_.text(comment.span)).pitch()) {
          tool.hasOtherThread = tool.hasOtherThread || (tool.thread && tool.thread->pitch != *pitch);
          tool.thread = Thread{*pitch, comment.span};
        }
  }
  void judge(const Tool &tool, BlockId block, const Reporter &reporter) const {
    const Word *feed = findWord(context_.tree, block, 'F');
    if (!feed || !feed->isNumber() || !tool.speed->isNumber() || feed->number().isZero() ||
        tool.speed->number().isZero() || unit_ == FeedUnit::Unknown)
      return;
    const bool isPerRevolution = unit_ == FeedUnit::PerRevolution;
    const double moved = feed->number().toDouble() / (isPerRevolution ? 1 : tool.speed->number().toDouble());
    const double pitch = tool.thread->pitch;
    const auto fits = [&](double unit) { return moved * unit < pitch * kMost && moved * unit * kMost > pitch; };
    const bool mayBeMetric = isMetric_ || !isInch_;
    const bool mayBeInch = isInch_ || !isMetric_;
    if ((mayBeMetric && fits(1)) || (mayBeInch && fits(kInch)))
      return;
    const double unit = mayBeMetric ? 1 : kInch;
    const double wanted = pitch / unit * (isPerRevolution ? 1 : tool.speed->number().toDouble());
    Diagnostic diagnostic{
        .message = fmt::format("{} is not the feed of the thread in the remark", context_.quoted(feed->span())),
        .span = feed->span(),
        .labels = {{tool.thread->comment, "the thread"}},
        .notes = {fmt::format("the tap moves {:.4g} in each revolution, where the pitch is {:.4g}: it breaks, or tears "
                              "the thread",
                              moved, pitch / unit),
                  fmt::format("the feed of this pitch is {:.5g}; correct the feed, the speed or the remark", wanted)}};
    if (!isPerRevolution)
      diagnostic.labels.push_back({tool.speed->span(), "the speed"});
    reporter.report(std::move(diagnostic));
  }

  const FileContext &context_;
  HiddenWork hidden_;
  const Program &program_;
  FeedUnit unit_ = FeedUnit::PerMinute;
  bool isInch_ = false;
  bool isMetric_ = false;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  const auto sections = toolSectionsOf(program, context);
  if (sections.empty())
    return;
  Reader reader(program, context);
  for (BlockId block = context.model.programs[program].first; block < sections.front().first; block = block.next())
    reader.noteUnit(block);
  for (const ToolSection &section : sections)
    reader.read(section, reporter);
}

} // namespace

extern const Rule feedOfOtherPitch;
const Rule feedOfOtherPitch{
    .info = {"feed-of-other-pitch", Category::Motion, Severity::Warning,
             "Reports a tapping cycle whose feed and speed do not make the pitch that the remark names."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::feed_of_other_pitch
