// Gouges: where and how deep the tool of a run goes where it must not, in plain numbers.
#pragma once

#include "proof/geometry/half_plane.h"

#include <map>
#include <span>

namespace feedhold::geometry {

using PlainShape = Shape<double, bool>;

/// What a contract says of space, for given arguments.
struct PlainRegion {
  std::string name;
  std::vector<PlainShape> parts; // together one region
  friend bool operator==(const PlainRegion &, const PlainRegion &) = default;
};
struct PlainSpace {
  std::optional<TipDirection> tip = {}; // of a lathe, whose shapes are those of half_plane.h
  std::optional<Tool<double>> tool = {};
  std::vector<PlainRegion> keepIn;
  std::vector<PlainRegion> keepOut;
  std::optional<double> clearance; // Z
  std::optional<Box<double>> travel;
  std::optional<Box<double>> machine = {}; // in machine coordinates
  /// The contract tells lengths of tools: coordinates are those of the tip where one is in force, and only there.
  bool knowsLengths = false;
  std::optional<double> longest = {}; // of them, with which the tip is lowest
  double corner = 0;                  // how far from its path the tool may be, on any side
  friend bool operator==(const PlainSpace &, const PlainSpace &) = default;
};

enum class SpaceClaim : std::uint8_t {
  KeepIn,    // cutting moves
  KeepOut,   // all moves
  Clearance, // rapid moves
  Travel,    // all moves; the point alone
  Machine,   // the same in machine coordinates
};

/// Whether a claim is about the tool itself, which may leave its path, and not about the points that are commanded: the
/// limits of an axis are limits of these.
bool isOfToolBesidePath(SpaceClaim claim);

struct Gouge {
  std::size_t move;                  // index
  Point<double> at;                  // the point of the tool on its path
  double depth;                      // by how much the tool is wrong there, above 0
  std::optional<double> length = {}; // of the tool in the spindle, where none is in force: PlainSpace::longest
  double beside = 0;                 // how far from its path the tool is deepest: PlainSpace::corner
};

/// Which moves are looked at; empty: all.  What came before them still counts.
using MoveFilter = std::function<bool(const RecordedMove &)>;

/// Where a run breaks one claim most; `region`: index of keepIn or keepOut.  Rapid moves go straight, and each axis by
/// itself at any rate of its own: anywhere in the box between the ends.  What an unmodelled move does
/// (MoveKind::Unmodelled), or one with cutter compensation that the run does not follow, is not looked at.
std::optional<Gouge> deepestGouge(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                  std::span<const RecordedMove> moves, const MoveFilter &filter = {});

/// How far the tool keeps from what it must not touch, where the run never does; absent: nothing bounds it.
std::optional<double> smallestMargin(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                     std::span<const RecordedMove> moves, const MoveFilter &filter = {});

/// How deep runs break one claim in each block (RecordedMove::own), as deepestGouge would find it for each by itself.
class BlockDepths {
public:
  /// For gouges.
  static BlockDepths ofGouges(SpaceClaim claim, std::size_t region);
  /// For margins, which are depths below 0: however far away the tool keeps.
  static BlockDepths ofMargins(SpaceClaim claim, std::size_t region);

  /// The moves of one more run, in one walk.  It adds nothing where all is as in the run before, which still exists: a
  /// program without inputs makes the same moves in each.
  void add(const PlainSpace &space, std::span<const RecordedMove> moves);
  const std::map<Place, double> &depths() const { return depths_; }

private:
  BlockDepths(SpaceClaim claim, std::size_t region, double floor) : claim_(claim), region_(region), floor_(floor) {}

  SpaceClaim claim_;
  std::size_t region_;
  double floor_;
  std::map<Place, double> depths_;
  const PlainSpace *space_ = nullptr; // of the run before
  std::span<const RecordedMove> moves_ = {};
};

/// Where the point of the tool is at a share of a move, 0..1; rapid moves straight.
Point<double> pointOf(const RecordedMove &move, double share);

} // namespace feedhold::geometry
