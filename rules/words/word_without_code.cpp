// word-without-code: `M65 P1 L3` where a word that no code of its block takes stops the control.
#include "rules/motion/ngc_block.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <span>
#include <string_view>

namespace feedhold::rules::word_without_code {
namespace {

/// Codes in tenths that take a word, as LinuxCNC's messages about the word name them.
struct Takers {
  char letter;
  std::string_view names;
  std::span<const std::uint16_t> gCodes;
  std::span<const std::uint16_t> mCodes;
};
constexpr std::array<std::uint16_t, 11> kOfD = {410, 411, 420, 421, 520, 700, 710, 711, 712, 720, 960};
constexpr std::array<std::uint16_t, 8> kOfE = {700, 710, 711, 712, 720, 721, 722, 760};
constexpr std::array<std::uint16_t, 3> kOfEByM = {660, 670, 680};
constexpr std::array<std::uint16_t, 3> kOfH = {430, 432, 760};
constexpr std::array<std::uint16_t, 18> kOfL = {52,  100, 410, 411, 420, 421, 730, 740, 760,
                                                810, 820, 830, 840, 850, 860, 870, 880, 890};
constexpr std::array<std::uint16_t, 2> kOfLByM = {660, 980};
constexpr std::array<std::uint16_t, 15> kOfI = {20, 30, 50, 51, 52, 100, 331, 700, 710, 711, 712, 720, 721, 760, 870};
constexpr std::array<std::uint16_t, 8> kOfJ = {20, 30, 50, 51, 52, 100, 760, 870};
constexpr std::array<std::uint16_t, 6> kOfK = {20, 30, 330, 331, 760, 870};
constexpr std::array<std::uint16_t, 24> kOfP = {20,  30,  40,  50,  52,  53,  62,  63,  100, 640, 700, 710,
                                                711, 712, 720, 721, 722, 740, 760, 820, 840, 860, 880, 890};
constexpr std::array<std::uint16_t, 12> kOfPByM = {190, 500, 510, 520, 530, 620, 630, 640, 650, 660, 980, 990};
constexpr std::array<std::uint16_t, 15> kOfQ = {50, 62, 63, 100, 640, 700, 710, 711, 712, 720, 721, 722, 730, 760, 830};
constexpr std::array<std::uint16_t, 5> kOfQByM = {190, 610, 660, 670, 680};
/// G64 R is of newer versions.
constexpr std::array<std::uint16_t, 25> kOfR = {20,  30,  100, 411, 421, 640, 700, 710, 711, 712, 720, 721, 722,
                                                730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880, 890};
constexpr std::array<std::uint16_t, 1> kOfRByM = {190};
constexpr std::array<std::uint16_t, 6> kOfSpindle = {330, 331, 760, 950, 960, 970};
constexpr std::array<std::uint16_t, 5> kOfSpindleByM = {30, 40, 50, 190, 510};
constexpr std::array kTakers = {
    Takers{'D', "G41, G42 or G96", kOfD, {}},
    Takers{'E', "G70, G76, M66, M67 or M68", kOfE, kOfEByM},
    Takers{'H', "G43 or G76", kOfH, {}},
    Takers{'I', "G2, G3, G5, G5.1, G10, G33.1, G76 or G87", kOfI, {}},
    Takers{'J', "G2, G3, G5, G5.1, G10, G76 or G87", kOfJ, {}},
    Takers{'K', "G2, G3, G33, G33.1, G76 or G87", kOfK, {}},
    Takers{'L', "G10, G41, G42, a canned cycle, M66 or M98", kOfL, kOfLByM},
    Takers{'P', "arcs, splines, G4, G10, G64, cycles with a dwell, M19, M50 to M53 and M62 to M66", kOfP, kOfPByM},
    Takers{'Q', "G5, G10, G64, G73, G76, G83, M19, M61 and M66 to M68", kOfQ, kOfQByM},
    Takers{'R', "arcs, canned cycles, G10, G41.1, G42.1, G76 and M19", kOfR, kOfRByM},
    Takers{'$', "M3, M4, M5, M19, M51, G33, G76, G95, G96, G97 or S", kOfSpindle, kOfSpindleByM},
};
/// They move along three axes only.
constexpr std::array<std::uint16_t, 11> kCycles = {730, 740, 810, 820, 830, 840, 850, 860, 870, 880, 890};
constexpr std::string_view kAxesOfRotation = "ABC";

/// Words that a code refuses although another one of the block may take them.
struct Refusals {
  char address;
  std::uint16_t tenths;
  std::string_view letters;
  std::string_view why;
};
constexpr std::array kRefusals = {
    Refusals{'G', 330, "F", "the speed of the spindle and K say how fast it moves"},
    Refusals{'G', 331, "F", "the speed of the spindle and K say how fast it moves"},
    Refusals{'G', 760, "ABCUV", "a thread is cut along X and Z"},
    Refusals{'G', 50, "ZABC", "a spline lies in the plane of X and Y"},
    Refusals{'G', 51, "ZABC", "a spline lies in the plane of X and Y"},
};

bool takes(const Takers &takers, std::uint16_t tenths, char address) {
  const auto codes = address == 'G' ? takers.gCodes : takers.mCodes;
  return std::ranges::find(codes, tenths) != codes.end();
}

bool isCentre(char letter) { return letter == 'I' || letter == 'J' || letter == 'K'; }

/// By which codes a block without one of its own may move.
enum class Movement : std::uint8_t { None, Stated, InForce };
Movement movementOf(const NgcBlock &block, char letter) {
  if (block.motion())
    return Movement::Stated;
  // `I5` alone is an arc where one is in force.
  return block.movesByModal() || (isCentre(letter) && !block.givesAxesAway()) ? Movement::InForce : Movement::None;
}

class WordWithoutCode final : public FlowRule {
public:
  WordWithoutCode(ProgramId program, const FileContext &context)
      : view_(program, context), isAsked_(context.dialect.behaviour.stopsAtStrayWords) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!isAsked_)
      return;
    const bool isNew = !known_.contains(node);
    if (isNew)
      known_.emplace(node, strayIn(node, state));
    else if (const auto now = strayIn(node, state); now != known_[node])
      known_[node] = nullptr;
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, word] : known_)
      if (word)
        tell(node, *word, context, reporter);
  }

private:
  /// The first word that the control refuses; null: it takes all, or not everything is known.
  const Word *strayIn(NodeId node, const AbstractState &state) const {
    const auto block = NgcBlock::of(view_, node);
    if (!block)
      return nullptr;
    for (const Word *word : block->words()) {
      if (kAxesOfRotation.find(word->address()) != std::string_view::npos && movesByCycle(*block, state))
        return word;
      if (refusalOf(*block, *word).code)
        return word;
      const auto takers = std::ranges::find(kTakers, word->address(), &Takers::letter);
      if (takers != kTakers.end() && isStray(*takers, *block, state))
        return word;
    }
    return nullptr;
  }
  struct Refused {
    const Word *code; // null: none refuses it
    std::string_view why;
  };
  static Refused refusalOf(const NgcBlock &block, const Word &word) {
    for (const Refusals &refusals : kRefusals)
      if (refusals.letters.find(word.address()) != std::string_view::npos)
        if (const Word *code = block.code(refusals.address, {refusals.tenths}))
          return {code, refusals.why};
    const Word *data = block.code('G', {100});
    const Word *table = data ? block.find('L') : nullptr;
    const auto kind = table ? table->integer() : std::nullopt;
    if ((kind == 2 || kind == 20) && (word.address() == 'I' || word.address() == 'J'))
      return {data, "only tools have the angles I and J"};
    if (kind == 20 && word.address() == 'R')
      return {data, "only L2 turns a coordinate system"};
    const Word *wait = block.code('M', {660});
    if (wait && word.address() == 'E' && block.find('P'))
      return {wait, "it reads one input, of P or of E"};
    const Word *more = block.code('G', {432});
    if (more && word.address() == 'H' && block.namesAxes())
      return {more, "the offset is that of a tool, or the axis words"};
    return {nullptr, {}};
  }
  bool isStray(const Takers &takers, const NgcBlock &block, const AbstractState &state) const {
    for (const Word *word : block.words())
      if (word->isCode() && takes(takers, *word->tenths(), word->address()))
        return false;
    if (takers.letter == '$')
      return !block.find('S') && (movementOf(block, '$') != Movement::InForce || noneInForceTakes(takers, state));
    return movementOf(block, takers.letter) != Movement::InForce || noneInForceTakes(takers, state);
  }
  bool noneInForceTakes(const Takers &takers, const AbstractState &state) const {
    if (std::ranges::none_of(takers.gCodes, [&](std::uint16_t tenths) { return isMotion(tenths); }))
      return true;
    const auto motions = motionsInForce(view_, state);
    return motions && std::ranges::none_of(*motions, [&](std::uint16_t each) { return takes(takers, each, 'G'); });
  }
  bool isMotion(std::uint16_t tenths) const {
    const Code *code = findGCode(view_.context().dialect, tenths);
    return code && code->group == view_.modes().groupOf(ModalKind::Motion);
  }
  bool movesByCycle(const NgcBlock &block, const AbstractState &state) const {
    if (block.motion())
      return block.code('G', kCycles) != nullptr;
    const auto motions = block.movesByModal() ? motionsInForce(view_, state) : std::nullopt;
    return motions && !motions->empty() && std::ranges::all_of(*motions, [](std::uint16_t each) {
             return std::ranges::find(kCycles, each) != kCycles.end();
           });
  }
  void tell(NodeId node, const Word &word, const FileContext &context, const Reporter &reporter) const {
    if (const auto [code, why] = refusalOf(*NgcBlock::of(view_, node), word); code)
      return reporter.report(
          {.message = fmt::format("{} does not take {}", context.quoted(code->span()), context.quoted(word.span())),
           .span = word.span(),
           .labels = {{code->span(), "this code"}},
           .notes = {fmt::format("the control stops with an error: {}", why), "delete the word, or correct the code"}});
    if (kAxesOfRotation.find(word.address()) != std::string_view::npos)
      return reporter.report({.message = fmt::format("a canned cycle does not take {}", context.quoted(word.span())),
                              .span = word.span(),
                              .notes = {"the control stops with an error: cycles move along X, Y and Z",
                                        "turn the axis in a block of its own, before the cycle"}});
    if (word.address() == 'P' && tellAlone(word, view_.node(node).block, context, reporter))
      return;
    const Takers &takers = *std::ranges::find(kTakers, word.address(), &Takers::letter);
    reporter.report(
        {.message = fmt::format("no code of this block takes {}", context.quoted(word.span())),
         .span = word.span(),
         .notes = {fmt::format("the control stops with an error: {} stands only with {}", takers.letter, takers.names),
                   "correct the code of the block, or delete the word"}});
  }
  /// Many codes take P; none does in a block of its own, where `G4 P2` was meant.
  static bool tellAlone(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
    const bool isAlone = std::ranges::all_of(
        context.tree.wordsOf(block), [&](const Word &other) { return &other == &word || other.address() == 'N'; });
    if (!isAlone || !context.tree.statementsOf(block).empty())
      return false;
    reporter.report({.message = fmt::format("no code stands beside {}", context.quoted(word.span())),
                     .span = word.span(),
                     .notes = {"the control stops with an error: P needs a code such as G4 in its block",
                               "write the code, as in `G4 P2` for a wait of 2 seconds"}});
    return true;
  }

  MotionView view_;
  bool isAsked_;
  std::map<NodeId, const Word *> known_; // on all paths
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<WordWithoutCode>(program, context);
}

} // namespace

extern const Rule wordWithoutCode;
const Rule wordWithoutCode{
    .info = {"word-without-code", Category::Word, Severity::Error,
             "Reports a word, such as `H1` or `P2`, in a block without a code that takes it, where the control stops "
             "for that."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::word_without_code
