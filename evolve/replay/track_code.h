#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evolve/life/life.h"

namespace metamorph::evolve {

// How moving points lie in a page. Coordinates are whole numbers of 1/256 d. Frames are cut into
// chunks of 256 that are read one by one, so that seeking reads one or two. A chunk is a zlib
// stream of varints: of every point that is there in it, in order, its x and then its y: the first
// number, the first difference, then second differences, all zigzag. evolve/replay/read.js reads
// it.

inline constexpr double coordinate_step = 1.0 / 256;  ///< d
inline constexpr int chunk_frames = 256;

/// A point from frame `first` on: cells are born and die, nodes are there from 0 to the end.
struct Course {
  int first = 0;
  std::vector<double> x, y;  ///< d, by frame
};

/// Chunks of all frames in which there is a point.
std::vector<std::string> pack(std::span<const Course> courses);

/// Replaces the coordinates of courses of the same frames by what the chunks hold.
void unpack(std::span<const std::string> chunks, std::vector<Course>& courses);

/// A track of which every n-th frame is kept, and the last one.
struct PackedTrack {
  double interval = 0;  ///< time units between two frames of the track
  int frames = 0;       ///< of the track
  int every = 1;
  std::vector<std::string> chunks;  ///< of the frames kept
};

/// How far the picture of a track lies from the track.
struct TrackError {
  double worst = 0;      ///< d
  double far_share = 0;  ///< of all nodes in all frames, those more than `picture_error` away
};

inline constexpr double picture_error = 0.01;       ///< d
inline constexpr double picture_far_share = 0.001;  ///< of nodes and frames may be farther
inline constexpr double picture_worst = 0.05;       ///< d

/// Keeps as few frames as the limits above allow; where all are kept the error is that of rounding,
/// 0.003 d.
PackedTrack pack(const Track& track);

/// Where the page shows a coordinate at `frame` of the track (0 to frames - 1, not only whole
/// ones): a cubic Hermite spline through the frames kept with the slopes of Catmull and Rom.
double shown_at(std::span<const double> kept, int every, int frames, double frame);

/// The error of what the page shows in the frames of the track.
TrackError error_of(const Track& track, const PackedTrack& packed);

/// zlib's stream of these bytes, the smallest it makes.
std::string deflated(std::string_view bytes);

/// Appends whole numbers as varints: seven bits a byte, lowest first; signed ones as zigzag.
void append_varint(std::string& bytes, std::uint64_t value);
void append_signed(std::string& bytes, std::int64_t value);

}  // namespace metamorph::evolve
