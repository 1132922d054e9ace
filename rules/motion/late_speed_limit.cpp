// late-speed-limit: `G96 S660 M03`, and `G50 S1000` only behind it.
#include "rules/motion/tool_sections.h"
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::late_speed_limit {
namespace {

bool does(const Code *code, std::initializer_list<CodeAction> actions) {
  return code && std::ranges::find(actions, code->action) != actions.end();
}

/// Follows G96, M03 and the limit through the text of one program.
class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), hidden_(program, context) {}

  /// The first limit, once it is found that it comes too late; another one may have been in force before a call.
  void read(BlockId block, const Reporter &reporter) {
    if (hidden_.isIn(block))
      isLimited_ = true;
    if (isLimited_)
      return;
    for (const Word &word : context_.tree.wordsOf(block))
      readCode(word, word.isCode() ? codeOf(word, context_.dialect) : nullptr);
    if (const auto limit = speedLimitIn(block, context_)) {
      isLimited_ = true;
      if (surface_ && start_)
        tell(*limit, reporter);
    }
  }

private:
  void readCode(const Word &word, const Code *code) {
    if (does(code, {CodeAction::ConstantSurface}))
      surface_ = &word;
    else if (does(code, {CodeAction::ConstantSpeed}))
      surface_ = nullptr;
    else if (does(code, {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise}))
      start_ = &word;
    else if (does(code, {CodeAction::SpindleStop}) || (code && code->role == CodeRole::ProgramEnd))
      start_ = nullptr;
    const bool isAcross = word.address() == 'X' || word.address() == 'U';
    if (surface_ && start_ && isAcross)
      moved_ = moved_ ? moved_ : &word;
    else if (!surface_ || !start_)
      moved_ = nullptr;
  }

  void tell(const SpeedLimit &limit, const Reporter &reporter) const {
    Diagnostic diagnostic{
        .message = fmt::format("{} limits the speed only after {} has started the spindle without a limit",
                               context_.quoted(limit.span()), context_.quoted(surface_->span())),
        .span = limit.span(),
        .labels = {{surface_->span(), "constant surface speed"}},
        .notes = {"with constant surface speed the spindle gets faster the nearer the tool is to the centre, here up "
                  "to the limit of the program before",
                  fmt::format("write the limit before {}", context_.quoted(surface_->span()))}};
    if (start_ != surface_)
      diagnostic.labels.push_back({start_->span(), "started here"});
    if (moved_)
      diagnostic.labels.push_back({moved_->span(), "moves in X without the limit"});
    reporter.report(std::move(diagnostic), moved_ ? Severity::Warning : Severity::Info);
  }

  const FileContext &context_;
  HiddenWork hidden_;
  const Word *surface_ = nullptr; // G96, in force
  const Word *start_ = nullptr;   // M03, M04, in force
  const Word *moved_ = nullptr;   // the first X behind both
  bool isLimited_ = false;        // or it is not known
};

} // namespace

extern const Rule lateSpeedLimit;
const Rule lateSpeedLimit{.info = {"late-speed-limit", Category::Motion, Severity::Warning,
                                   "Reports a speed limit that comes only after constant surface speed and the start "
                                   "of the spindle."},
                          .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::late_speed_limit
