// feed-of-other-pitch: `(TAP M8X1.25)`, `S500`, and then `G84 Z-20. F500.`; `S1000` and `G84 Z-5. F10.`
#include "rules/motion/tool_sections.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::rules::feed_of_other_pitch {
namespace {

constexpr double kInch = 25.4;
constexpr double kMost = 1.1; // a floating holder is fed a little slower, and numbers are rounded

/// The pitches that a thread may have, in millimetres.
struct Pitches {
  double least;
  double most;
  bool operator==(const Pitches &) const = default;
};
constexpr Pitches kOfAnyTap = {0.2, 8}; // M1 has 0.25, a pipe of 2 inches 2.3

struct Thread {
  Pitches pitches;
  std::optional<double> pitch; // where the remark names it
  Span comment;
};

/// ISO 261: the coarse pitch; fine ones go down to a third of it.
std::optional<Pitches> pitchesOf(double diameter) {
  constexpr std::array<std::pair<double, double>, 11> kCoarse = {
      {{3, 0.5}, {4, 0.7}, {5, 0.8}, {6, 1}, {8, 1.25}, {10, 1.5}, {12, 1.75}, {14, 2}, {16, 2}, {20, 2.5}, {24, 3}}};
  const auto row = std::ranges::find(kCoarse, diameter, &std::pair<double, double>::first);
  return row == kCoarse.end() ? std::nullopt : std::optional(Pitches{row->second / 3, row->second * kMost});
}

/// Reads one comment from the left.
class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  /// `M8X1.25`, `M8 - 1.25`; `1/4-20`, `10-32`, of a comment that says TAP.
  std::optional<double> pitch() {
    const bool isTap = hasWord("TAP");
    return first([&] { return toUpper(text_[at_]) == 'M' ? metric() : isTap ? inch() : std::nullopt; });
  }
  /// `TAP M6`, `6MM TAP`
  std::optional<double> diameter() {
    return hasWord("TAP") ? first([&] { return size(); }) : std::nullopt;
  }

private:
  template <typename Read> std::optional<double> first(Read read) {
    for (at_ = 0; at_ < text_.size(); ++at_) {
      if (at_ > 0 && (isLetter(text_[at_ - 1]) || isDigit(text_[at_ - 1]) || text_[at_ - 1] == '.'))
        continue;
      const std::size_t start = at_;
      if (const std::optional<double> found = read())
        return found;
      at_ = start;
    }
    return std::nullopt;
  }
  std::optional<double> size() {
    const bool isMetric = take("M");
    const auto found = number();
    if (found && !isMetric) {
      skipBlanks();
      if (!take("M") || !take("M"))
        return std::nullopt;
    }
    return goesOn() ? std::nullopt : found;
  }
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
      if (taps && !tool.hasOtherThread && tool.speed && !tool.isHidden)
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
        if (const auto thread = threadIn(comment))
          noteThread(*thread, tool);
  }
  /// A remark with the pitch says more than one with the diameter alone.
  static void noteThread(const Thread &thread, Tool &tool) {
    const bool isKnown = tool.thread && (tool.thread->pitch || !thread.pitch);
    if (isKnown && tool.thread->pitch && !thread.pitch)
      return;
    tool.hasOtherThread = tool.hasOtherThread || (isKnown && tool.thread->pitches != thread.pitches);
    tool.thread = thread;
  }
  std::optional<Thread> threadIn(const Comment &comment) const {
    Scanner scanner(context_.text(comment.span));
    if (const auto pitch = scanner.pitch())
      return Thread{{*pitch / kMost, *pitch * kMost}, pitch, comment.span};
    const auto diameter = scanner.diameter();
    const auto pitches = diameter ? pitchesOf(*diameter) : std::nullopt;
    return pitches ? std::optional(Thread{*pitches, std::nullopt, comment.span}) : std::nullopt;
  }
  void judge(const Tool &tool, BlockId block, const Reporter &reporter) const {
    const Word *feed = findWord(context_.tree, block, 'F');
    if (!feed || !feed->isNumber() || !tool.speed->isNumber() || feed->number().isZero() ||
        tool.speed->number().isZero() || unit_ == FeedUnit::Unknown)
      return;
    const bool isPerRevolution = unit_ == FeedUnit::PerRevolution;
    const double moved = feed->number().toDouble() / (isPerRevolution ? 1 : tool.speed->number().toDouble());
    const Pitches pitches = tool.thread ? tool.thread->pitches : kOfAnyTap;
    const auto fits = [&](double unit) { return moved * unit < pitches.most && moved * unit > pitches.least; };
    const bool mayBeMetric = isMetric_ || !isInch_;
    const bool mayBeInch = isInch_ || !isMetric_;
    if ((mayBeMetric && fits(1)) || (mayBeInch && fits(kInch)))
      return;
    const double unit = mayBeMetric ? 1 : kInch;
    const std::string_view what =
        tool.thread ? "is not the feed of the thread in the remark" : "makes a pitch that no tap has";
    Diagnostic diagnostic{.message = fmt::format("{} {}", context_.quoted(feed->span()), what),
                          .span = feed->span(),
                          .notes = {fmt::format("the tap moves {:.4g} in each revolution, where {}: it breaks, or "
                                                "tears the thread",
                                                moved, expected(tool.thread, unit)),
                                    advice(tool, unit, isPerRevolution)}};
    if (tool.thread)
      diagnostic.labels.push_back({tool.thread->comment, "the thread"});
    if (!isPerRevolution)
      diagnostic.labels.push_back({tool.speed->span(), "the speed"});
    reporter.report(std::move(diagnostic));
  }
  static std::string expected(const std::optional<Thread> &thread, double unit) {
    if (thread && thread->pitch)
      return fmt::format("the pitch is {:.4g}", *thread->pitch / unit);
    const Pitches &pitches = thread ? thread->pitches : kOfAnyTap;
    return fmt::format("pitches are {:.2g} to {:.2g}", pitches.least / unit, pitches.most / unit);
  }
  static std::string advice(const Tool &tool, double unit, bool isPerRevolution) {
    if (!tool.thread || !tool.thread->pitch)
      return isPerRevolution ? "the feed is the pitch: correct F"
                             : "the feed is the pitch times the speed: correct F or S";
    return fmt::format("the feed of this pitch is {:.5g}; correct the feed, the speed or the remark",
                       *tool.thread->pitch / unit * (isPerRevolution ? 1 : tool.speed->number().toDouble()));
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
    .info =
        {"feed-of-other-pitch", Category::Motion, Severity::Warning,
         "Reports a tapping cycle whose feed and speed do not make the pitch that the remark names, or none that a tap "
         "has."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::feed_of_other_pitch
