// Finding line ends 64 bytes at a time.  The byte that counts as the end is the LF, or a CR that no LF follows.
#include "base/source/line_index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace feedhold {

namespace {

using Mask = std::uint64_t; // bit i speaks of byte i of a piece of 64 bytes

constexpr std::uint32_t kPiece = 64;
constexpr std::uint32_t kPieces = 4;
constexpr std::uint32_t kChunk = kPiece * kPieces;

#ifdef __SSE2__
Mask maskOf(const char *piece, char wanted) {
  const __m128i pattern = _mm_set1_epi8(wanted);
  Mask mask = 0;
  for (int part = 0; part < 4; ++part) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i *>(piece) + part);
    const auto bits = static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_cmpeq_epi8(bytes, pattern)));
    mask |= static_cast<Mask>(bits) << (16 * part);
  }
  return mask;
}
#else
Mask maskOf(const char *piece, char wanted) {
  Mask mask = 0;
  for (std::uint32_t i = 0; i < kPiece; ++i)
    mask |= static_cast<Mask>(piece[i] == wanted) << i;
  return mask;
}
#endif

/// The CRs from which a run of CRs leads to an LF: each step doubles the distance over which the answer has travelled
/// back (the parallel-prefix fill known from chess programs as Kogge-Stone).
Mask returnsBeforeLineFeed(Mask lineFeeds, Mask returns, bool lineFeedFollows) {
  Mask found = returns & ((lineFeeds >> 1) | (static_cast<Mask>(lineFeedFollows) << 63));
  if (found == returns) // every CR stands directly before its LF: the usual file
    return found;
  Mask open = returns;
  for (int distance = 1; distance < 64; distance *= 2) {
    found |= open & (found >> distance);
    open &= open >> distance;
  }
  return found;
}

std::uint32_t bitCount(Mask mask) { return static_cast<std::uint32_t>(std::popcount(mask)); }

struct Piece {
  Mask ends;
  bool startsInLineEnd;
};

Piece readPiece(const char *bytes, bool lineFeedFollows) {
  const Mask lineFeeds = maskOf(bytes, '\n');
  const Mask returns = maskOf(bytes, '\r');
  if (returns == 0)
    return {lineFeeds, (lineFeeds & 1) != 0};
  const Mask inside = returnsBeforeLineFeed(lineFeeds, returns, lineFeedFollows);
  return {lineFeeds | (returns & ~inside), ((lineFeeds | inside) & 1) != 0};
}

struct ChunkEnds {
  std::array<Mask, kPieces> ends;
  bool startsInLineEnd;

  std::uint32_t count() const {
    std::uint32_t sum = 0;
    for (const Mask mask : ends)
      sum += bitCount(mask);
    return sum;
  }
  /// Line ends among the first `length` bytes.
  std::uint32_t countBefore(std::uint32_t length) const {
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < length / kPiece; ++i)
      sum += bitCount(ends[i]);
    if (length % kPiece != 0)
      sum += bitCount(ends[length / kPiece] << (kPiece - length % kPiece));
    return sum;
  }
  /// The place of the `number`-th line end, counted from 1; there are that many.
  std::uint32_t place(std::uint32_t number) const {
    std::uint32_t piece = 0;
    for (; number > bitCount(ends[piece]); ++piece)
      number -= bitCount(ends[piece]);
    Mask mask = ends[piece];
    for (; number > 1; --number)
      mask &= mask - 1;
    return piece * kPiece + static_cast<std::uint32_t>(std::countr_zero(mask));
  }
};

/// Reads backwards, because what a CR means depends on what follows it.
ChunkEnds readChunk(std::string_view text, std::size_t chunk, bool lineFeedFollows) {
  const std::string_view bytes = text.substr(chunk * kChunk, kChunk);
  std::array<char, kChunk> padded;
  const char *data = bytes.data();
  if (bytes.size() < kChunk) {
    padded.fill('\0');
    std::memcpy(padded.data(), bytes.data(), bytes.size());
    data = padded.data();
  }
  ChunkEnds result = {{}, lineFeedFollows};
  for (std::uint32_t i = kPieces; i-- > 0;) {
    const Piece piece = readPiece(data + i * kPiece, result.startsInLineEnd);
    result.ends[i] = piece.ends;
    result.startsInLineEnd = piece.startsInLineEnd;
  }
  return result;
}

} // namespace

LineIndex::LineIndex(std::string_view text) : chunks_((text.size() + kChunk - 1) / kChunk) {
  bool follows = false;
  for (std::size_t i = chunks_.size(); i-- > 0;) {
    const ChunkEnds ends = readChunk(text, i, follows);
    follows = ends.startsInLineEnd;
    chunks_[i] = {ends.count(), follows};
  }
  for (Chunk &chunk : chunks_)
    lineEnds_ += std::exchange(chunk.endsBefore, lineEnds_);
}

bool LineIndex::lineFeedFollows(std::size_t chunk) const {
  return chunk + 1 < chunks_.size() && chunks_[chunk + 1].startsInLineEnd;
}

std::uint32_t LineIndex::lineOf(std::string_view text, std::uint32_t offset) const {
  if (offset >= text.size())
    return lineCount();
  const std::size_t chunk = offset / kChunk;
  const ChunkEnds ends = readChunk(text, chunk, lineFeedFollows(chunk));
  return chunks_[chunk].endsBefore + ends.countBefore(offset % kChunk) + 1;
}

std::uint32_t LineIndex::behindLineEnd(std::string_view text, std::uint32_t number) const {
  const auto after = std::ranges::lower_bound(chunks_, number, {}, &Chunk::endsBefore);
  const auto chunk = static_cast<std::size_t>(after - chunks_.begin()) - 1;
  const ChunkEnds ends = readChunk(text, chunk, lineFeedFollows(chunk));
  return static_cast<std::uint32_t>(chunk) * kChunk + ends.place(number - chunks_[chunk].endsBefore) + 1;
}

Span LineIndex::lineSpan(std::string_view text, std::uint32_t line) const {
  const std::uint32_t begin = line == 1 ? 0 : behindLineEnd(text, line - 1);
  if (line > lineEnds_)
    return {begin, static_cast<std::uint32_t>(text.size())};
  std::uint32_t end = behindLineEnd(text, line) - 1;
  if (text[end] == '\n')
    while (end > begin && text[end - 1] == '\r')
      --end;
  return {begin, end};
}

} // namespace feedhold
