#include "proof/geometry/gouge_search.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace feedhold::geometry {

namespace {

constexpr int kMostHalvings = 9; // of a round
constexpr std::size_t kMostQuarterings = 2000;
constexpr double kNearEnough = 1e-3;
constexpr int kClimbs = 50;
/// Of a depth of which nothing is known.
constexpr double kMostSteps = 128; // of a way
constexpr double kMostGrid = 24;   // of a side

double stepsOf(double length, double step, double most) { return std::clamp(std::ceil(length / step), 1.0, most); }

/// Takes down the deepest of the points that are tried.
class Search {
public:
  Search(const GougePath &path, const Depth &depth, double floor) : path_(path), depth_(depth), best_(floor) {}

  double at(double share) {
    const double depth = depth_(path_.at(share));
    if (depth > best_ + kDeeper) {
      best_ = depth;
      share_ = share;
    }
    return depth;
  }
  /// Halves until no piece can have a deeper point: the depth changes by no more than the length of the way.
  void halve(double from, double to, double depthFrom, double depthTo, int halvings) {
    const double length = path_.length() * (to - from);
    if ((depthFrom + depthTo + length) / 2 <= best_ || halvings == 0)
      return;
    const double middle = (from + to) / 2;
    const double depthMiddle = at(middle);
    // The deeper half first: it may spare the other.
    const bool second = depthTo > depthFrom;
    for (const bool isSecond : {second, !second}) {
      if (isSecond)
        halve(middle, to, depthMiddle, depthTo, halvings - 1);
      else
        halve(from, middle, depthFrom, depthMiddle, halvings - 1);
    }
  }
  /// Up to the top of a hill between two shares: golden section.
  void climb(double from, double to) {
    constexpr double kGolden = 0.6180339887498949;
    double left = to - kGolden * (to - from);
    double right = from + kGolden * (to - from);
    double depthLeft = at(left);
    double depthRight = at(right);
    for (int i = 0; i < kClimbs; ++i) {
      if (depthLeft > depthRight) {
        to = std::exchange(right, left);
        depthRight = depthLeft;
        left = to - kGolden * (to - from);
        depthLeft = at(left);
      } else {
        from = std::exchange(left, right);
        depthLeft = depthRight;
        right = from + kGolden * (to - from);
        depthRight = at(right);
      }
    }
  }
  void climbAround(double step) {
    if (share_)
      climb(std::max(0.0, *share_ - step), std::min(1.0, *share_ + step));
  }
  double best() const { return best_; }
  std::optional<Deepest> found() const {
    return share_ ? std::optional(Deepest{path_.at(*share_), best_}) : std::nullopt;
  }

private:
  const GougePath &path_;
  const Depth &depth_;
  double best_;
  std::optional<double> share_;
};

void searchRounds(Search &search, const GougePath &path) {
  const auto rounds = static_cast<double>(path.rounds());
  // Many rounds are alike: each is cut less.
  const int halvings = std::max(3, kMostHalvings - static_cast<int>(std::log2(rounds)));
  double depthFrom = search.at(0);
  for (double round = 0; round < rounds; ++round) {
    const double depthTo = search.at((round + 1) / rounds);
    search.halve(round / rounds, (round + 1) / rounds, depthFrom, depthTo, halvings);
    depthFrom = depthTo;
  }
  search.climbAround(1 / rounds / (1 << halvings));
}

void searchLine(Search &search, double length) {
  const double ends = search.at(0) + search.at(1);
  if ((ends + length) / 2 > search.best())
    search.climb(0, 1);
}

class RectangleSearch {
public:
  RectangleSearch(const Depth &depth, double floor) : depth_(depth), best_(floor) {}

  double at(const Point<double> &point) {
    const double depth = depth_(point);
    if (depth > best_ + kDeeper) {
      best_ = depth;
      at_ = point;
    }
    return depth;
  }
  /// Quarters the rectangle that may hold the deepest point until none can be deeper, then climbs from the best.
  void quarter(const Point<double> &low, const Point<double> &high) {
    std::priority_queue<Part> parts;
    const auto add = [&](const Point<double> &middle, double width, double height) {
      parts.push({middle, width, height, at(middle) + std::hypot(width, height)});
    };
    add({(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]}, (high[0] - low[0]) / 2, (high[1] - low[1]) / 2);
    for (std::size_t i = 0; i < kMostQuarterings && !parts.empty(); ++i) {
      const Part part = parts.top();
      parts.pop();
      if (part.bound <= best_ + kNearEnough)
        break;
      for (const double x : {-part.width / 2, part.width / 2})
        for (const double y : {-part.height / 2, part.height / 2})
          add({part.middle[0] + x, part.middle[1] + y, low[2]}, part.width / 2, part.height / 2);
    }
    if (at_)
      climb(low, high);
  }
  void grid(const Point<double> &low, const Point<double> &high, double step) {
    const double columns = stepsOf(high[0] - low[0], step, kMostGrid);
    const double rows = stepsOf(high[1] - low[1], step, kMostGrid);
    for (double i = 0; i <= columns; ++i)
      for (double j = 0; j <= rows; ++j)
        at({low[0] + (high[0] - low[0]) * i / columns, low[1] + (high[1] - low[1]) * j / rows, low[2]});
  }
  std::optional<Deepest> found() const { return at_ ? std::optional(Deepest{*at_, best_}) : std::nullopt; }

private:
  struct Part {
    Point<double> middle;
    double width, height; // halves of them
    double bound;         // of the depth in it
    friend bool operator<(const Part &a, const Part &b) { return a.bound < b.bound; }
  };
  void climb(const Point<double> &low, const Point<double> &high) {
    for (double step = std::max(high[0] - low[0], high[1] - low[1]) / 64; step > kNearEnough * 1e-3;) {
      const double before = best_;
      const Point<double> middle = *at_;
      for (const double side : {-step, step}) {
        at({std::clamp(middle[0] + side, low[0], high[0]), middle[1], middle[2]});
        at({middle[0], std::clamp(middle[1] + side, low[1], high[1]), middle[2]});
      }
      if (best_ <= before)
        step /= 2;
    }
  }
  const Depth &depth_;
  double best_;
  std::optional<Point<double>> at_;
};

} // namespace

std::optional<Deepest> deepestOnPath(const GougePath &path, const Wanted &wanted) {
  Search search(path, wanted.depth, wanted.floor);
  switch (wanted.course) {
  case Course::RisesToEnds:
    search.at(0);
    search.at(1);
    break;
  case Course::RisesToOne: searchLine(search, path.length()); break;
  case Course::SingleAxes:
    for (const double share : path.extremes())
      search.at(share);
    break;
  case Course::NoFaster: searchRounds(search, path); break;
  case Course::Any: {
    const double steps = stepsOf(path.length(), wanted.step, kMostSteps);
    for (double i = 0; i <= steps; ++i)
      search.at(i / steps);
    search.climbAround(1 / steps);
    break;
  }
  }
  return search.found();
}

std::optional<Deepest> deepestInRectangle(const Point<double> &a, const Point<double> &b, const Wanted &wanted) {
  RectangleSearch search(wanted.depth, wanted.floor);
  const Point<double> low{std::min(a[0], b[0]), std::min(a[1], b[1]), a[2]};
  const Point<double> high{std::max(a[0], b[0]), std::max(a[1], b[1]), a[2]};
  for (const double x : {low[0], high[0]})
    for (const double y : {low[1], high[1]})
      search.at({x, y, low[2]});
  if (wanted.course == Course::Any)
    search.grid(low, high, wanted.step);
  else
    search.quarter(low, high);
  return search.found();
}

} // namespace feedhold::geometry
