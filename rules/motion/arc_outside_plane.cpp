// arc-outside-plane: a K beside G02 under G17.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::arc_outside_plane {
namespace {

struct PlaneLetters {
  CodeAction plane;
  char outside; // the distance to the centre that the plane does not have
  std::string_view code;
};
constexpr std::array kPlanes = {PlaneLetters{CodeAction::PlaneXY, 'K', "G17"},
                                PlaneLetters{CodeAction::PlaneZX, 'J', "G18"},
                                PlaneLetters{CodeAction::PlaneYZ, 'I', "G19"}};

class ArcOutsidePlane final : public FlowRule {
public:
  ArcOutsidePlane(ProgramId program, const FileContext &context) : view_(program, context) {}

  /// Where the control surely stops at such a word, nothing comes behind it.
  void before(NodeId node, const AbstractState &state) override {
    if (view_.context().dialect.switches.besideCentreStops == Switch::On && !view_.sets(node, ModalKind::Plane))
      note(node, state);
  }
  void after(NodeId node, const AbstractState &state) override {
    if (view_.context().dialect.switches.besideCentreStops != Switch::On || view_.sets(node, ModalKind::Plane))
      note(node, state);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, plane] : places_) {
      const Word *outside = plane ? findWordOf(node, plane->outside) : nullptr;
      const bool stops = context.dialect.switches.besideCentreStops == Switch::On;
      if (!outside || (isZero(*outside) && !stops) || outside->form() == WordForm::Missing) // missing-value tells of it
        continue;
      reporter.report({.message = fmt::format("{} does not belong to an arc in `{}`, the active plane",
                                              context.quoted(outside->span()), plane->code),
                       .span = outside->span(),
                       .flow = pathFromEntry(facts, node),
                       .notes = {stops ? "the control stops with an error"
                                       : "the control stops, or cuts the arc in the wrong plane",
                                 "select the plane before the arc: G17, G18 or G19"}},
                      stops ? Severity::Error : Severity::Warning);
    }
  }

private:
  void note(NodeId node, const AbstractState &state) {
    if (!view_.findAction(node, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) || isHavocked(state))
      return;
    const PlaneLetters *plane = nullptr;
    for (const PlaneLetters &candidate : kPlanes)
      if (view_.surely(state, ModalKind::Plane, {candidate.plane}))
        plane = &candidate;
    const auto [at, isNew] = places_.emplace(node, plane);
    if (!isNew && at->second != plane)
      at->second = nullptr;
  }
  const Word *findWordOf(NodeId node, char letter) const {
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == letter && !word->has(Word::kComma))
        return word;
    return nullptr;
  }
  static bool isZero(const Word &word) { return word.isNumber() && word.number().isZero(); }

  MotionView view_;
  std::map<NodeId, const PlaneLetters *> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ArcOutsidePlane>(program, context);
}

} // namespace

extern const Rule arcOutsidePlane;
const Rule arcOutsidePlane{.info = {"arc-outside-plane", Category::Motion, Severity::Warning,
                                    "Reports an arc whose centre (I, J, K) does not belong to the active plane."},
                           .hooks = {.watch = watch}};

} // namespace feedhold::rules::arc_outside_plane
