// TurningWalk: where the tool of a lathe is, block by block of the text of one program.
#pragma once

#include "rules/motion/tool_sections.h"
#include "rules/structure/structure_view.h"

#include <optional>
#include <vector>

namespace feedhold::rules {

/// Programmed coordinates, X as it is written; absent where it is not known.
struct TurningPoint {
  std::optional<double> x;
  std::optional<double> z;
};

enum class TurningMove : std::uint8_t {
  None,
  Rapid,
  Feed,
  Cycle,   // comes back to where it started
  Unknown, // moves, but the code in force is not known
};

/// G32 and its kin, and the cycles: G76 and G92 of G code system A, G76 and G78 of B, G78 and G21 of C.
bool cutsThread(const Code &code);

/// G81 to G85 and G89 drill, tap and bore along Z, on lathes whose tables do not have them all, too; so does G74 at X0.
bool drillsAlongZ(const Word &word, const FileContext &context);

/// `G50 S2500`, `G92 S2500`: the limit of the spindle.
struct SpeedLimit {
  const Word *code;
  const Word *speed;
  Span span() const { return {code->span().begin, speed->span().end}; }
};
std::optional<SpeedLimit> speedLimitIn(BlockId block, const FileContext &context);

/// The contour goes inwards all along its way to the chuck.
bool isOfBore(const std::vector<TurningPoint> &corners);

class TurningWalk {
public:
  TurningWalk(ProgramId program, const FileContext &context);

  /// Blocks are read in order of the text.  Those of the contour of a cycle above it are none that move by themselves.
  TurningMove read(BlockId block);
  /// Behind the last block that was read.
  const TurningPoint &at() const { return at_; }
  bool isMetric() const { return isMetric_; }
  /// Where the words of the block lead from there; of a cycle, its end point.
  TurningPoint endOf(BlockId block) const;
  /// Block by block, from a start: the corner points of a contour; empty where one of them is not known.
  std::vector<TurningPoint> cornersOf(const Contour &contour, const TurningPoint &start) const;
  const std::vector<Contour> &contours() const { return contours_; }
  /// Of a cycle above it.
  bool isInContour(BlockId block) const;

private:
  void moveTo(BlockId block, TurningPoint &point) const;
  std::optional<double> coordinate(const Word &word) const;
  bool follow(const Word &word);
  void lose() {
    at_ = {};
    motion_ = TurningMove::Unknown;
  }

  const FileContext &context_;
  HiddenWork hidden_;
  std::vector<Contour> contours_;
  TurningPoint at_;
  TurningMove motion_ = TurningMove::Unknown; // of the code in force
  bool isIncremental_ = false;
  bool isMetric_ = false; // as the program says
};

} // namespace feedhold::rules
