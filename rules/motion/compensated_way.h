// CompensatedWay: what a mill is told between G41 or G42 and G40, where all of it is known and lies in the plane.
#pragma once

#include "rules/motion/plane_points.h"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace feedhold::rules {

/// One movement, from one programmed point to the next.
struct Stretch {
  NodeId node;
  PlaneVector from;
  PlaneVector to;
  std::optional<PlaneVector> middle; // of an arc
  bool isRapid;
};

/// Straight and cut: not at rapid.
inline bool isEdge(const Stretch &stretch) { return !stretch.middle && !stretch.isRapid; }
inline PlaneVector directionOf(const Stretch &stretch) { return between(stretch.from, stretch.to); }
/// Of two directions, in radians: how far the second turns to the left of the first.
double turnBetween(const PlaneVector &first, const PlaneVector &second);
double distanceToSide(const PlaneVector &point, const PlaneVector &from, const PlaneVector &to);
/// The larger one along the two axes.
double extentOf(const std::vector<PlaneVector> &points);

struct CompensatedWay {
  NodeId code; // G41 or G42
  bool isLeft;
  std::vector<Stretch> stretches; // the first is the approach, on which the compensation begins
  bool endsInMove = false;        // the last one stands in the block of G40

  /// Behind the approach, and before the move of G40.
  std::span<const Stretch> contour() const;
  /// From the start of the approach on; arcs with the point in their middle.
  std::vector<PlaneVector> points() const;
  /// Two points that are as near are the same corner.
  double near() const;
  /// The part of the contour that comes back to a point, if it touches itself nowhere before; empty: none does.
  std::span<const Stretch> loopTo(const PlaneVector &point) const;
  /// The contour touches itself nowhere.
  bool isOpen() const;

private:
  /// The stretch ends at a point of an earlier one, or where it begins.
  bool comesBack(std::size_t index, double near) const;
};

/// A rule about such ways.  All runs through one have to be wrong.
class CompensatedWayRule : public FlowRule {
public:
  CompensatedWayRule(ProgramId program, const FileContext &context)
      : view_(program, context), isAsked_(context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId node, const AbstractState &state) final;
  void after(NodeId node, const AbstractState &state) final;
  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) final;

protected:
  virtual bool isWrong(const CompensatedWay &way) const = 0;
  virtual void tell(const CompensatedWay &way, const FileContext &context, const Reporter &reporter) const = 0;

  const MotionView &view() const { return view_; }
  /// Its G41 or G42.
  Span codeOf(const CompensatedWay &way) const;
  Span moveOf(const Stretch &stretch) const { return view_.modalMotionWords(stretch.node).front()->span(); }

private:
  bool mayLeaveContour(NodeId node) const;
  bool follow(NodeId node, const AbstractState &state);
  std::optional<Stretch> stretchOf(NodeId node, const AbstractState &state, const PlaneVector &end) const;
  std::optional<PlaneVector> middleOfArc(NodeId node, const AbstractState &state, const PlaneVector &end) const;
  std::optional<PlaneVector> middleByRadius(NodeId node, double side, const PlaneVector &end) const;
  void judge();

  MotionView view_;
  bool isAsked_;
  std::optional<PlaneVector> start_; // of the node that is being executed
  std::optional<CompensatedWay> way_;
  std::map<NodeId, CompensatedWay> wrong_; // by the node of the code
  std::set<NodeId> cleared_;               // by some run
};

} // namespace feedhold::rules
