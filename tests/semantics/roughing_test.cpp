// The cuts of G71 and G72 in plain numbers.
#include "meaning/semantics/roughing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace feedhold {
namespace {

RoughingPiece line(RoughingPoint start, RoughingPoint end) { return {start, end, std::nullopt}; }

TEST(Roughing, CutsEndOnTheContour) {
  // Radius 10 up to Z-10, a cone up to radius 15 at Z-15, a face up to radius 20.
  const std::vector contour{line({10, 2}, {10, -10}), line({10, -10}, {15, -15}), line({15, -15}, {20, -15})};
  const auto cuts = roughingCuts({{20, 2}, 3, contour});
  ASSERT_TRUE(cuts);
  ASSERT_EQ(cuts->size(), 3u); // at 17, 14 and 11; that at 8 is below the first piece
  EXPECT_NEAR((*cuts)[0].level, 17, 1e-9);
  EXPECT_NEAR((*cuts)[0].along, -15, 1e-9);
  EXPECT_NEAR((*cuts)[1].along, -14, 1e-9);
  EXPECT_NEAR((*cuts)[2].along, -11, 1e-9);
}

TEST(Roughing, AnArcIsMetOnItsOwnSide) {
  // A fillet of 5 about Z-5 and radius 15, from radius 10 to Z-10.
  RoughingPiece fillet = line({10, -5}, {15, -10});
  fillet.centre = RoughingPoint{15, -5};
  const auto cuts = roughingCuts({{14, 2}, 2, {line({10, 2}, {10, -5}), fillet}});
  ASSERT_TRUE(cuts);
  ASSERT_EQ(cuts->size(), 1u);
  EXPECT_NEAR((*cuts)[0].level, 12, 1e-9);
  EXPECT_NEAR((*cuts)[0].along, -5 - std::sqrt(25.0 - 9.0), 1e-9);
}

TEST(Roughing, ABoreIsCutOutwards) {
  const auto cuts = roughingCuts({{10, 1}, 2, {line({15, 1}, {15, -8}), line({15, -8}, {10, -8})}});
  ASSERT_TRUE(cuts);
  ASSERT_EQ(cuts->size(), 2u);
  EXPECT_NEAR((*cuts)[0].level, 12, 1e-9);
  EXPECT_NEAR((*cuts)[1].level, 14, 1e-9);
  EXPECT_NEAR((*cuts)[1].along, -8, 1e-9);
}

TEST(Roughing, WhatTurnsBackIsNotCut) {
  EXPECT_FALSE(roughingCuts({{20, 2}, 1, {line({10, 2}, {10, -10}), line({10, -10}, {8, -12})}}));
  EXPECT_FALSE(roughingCuts({{20, 2}, 1, {line({10, 2}, {10, -10}), line({10, -10}, {15, -8})}}));
  RoughingPiece wave = line({10, -5}, {15, -10});
  wave.centre = RoughingPoint{12, -6}; // beyond a quarter
  EXPECT_FALSE(roughingCuts({{20, 2}, 1, {line({10, 2}, {10, -5}), wave}}));
  EXPECT_FALSE(roughingCuts({{20, 2}, 0, {line({10, 2}, {10, -10})}}));
}

} // namespace
} // namespace feedhold
