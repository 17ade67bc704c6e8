#include "evolve/replay/track_code.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <new>

namespace metamorph::evolve {
namespace {

std::int64_t rounded(double coordinate) { return std::llround(coordinate / coordinate_step); }

int frames_of(std::span<const Course> courses) {
  std::size_t frames = 0;
  for (const Course& course : courses) {
    frames = std::max(frames, static_cast<std::size_t>(course.first) + course.x.size());
  }
  return static_cast<int>(frames);
}

/// The part of a course that lies in a chunk, as positions in its lists; empty: begin == end.
struct Part {
  std::size_t begin = 0, end = 0;
};

Part part_in(const Course& course, int chunk) {
  const int last = course.first + static_cast<int>(course.x.size());
  const int begin = std::max(course.first, chunk * chunk_frames);
  const int end = std::min(last, (chunk + 1) * chunk_frames);
  if (begin >= end) return {};
  return {static_cast<std::size_t>(begin - course.first),
          static_cast<std::size_t>(end - course.first)};
}

void append_coordinates(std::string& bytes, const std::vector<double>& values, Part part) {
  std::int64_t before = 0, slope = 0;
  for (std::size_t k = part.begin; k < part.end; ++k) {
    const std::int64_t value = rounded(values[k]), difference = value - before;
    append_signed(bytes, difference - slope);
    slope = k == part.begin ? 0 : difference;
    before = value;
  }
}

/// Reads what append_signed() wrote.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  std::int64_t next_signed() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_[place_++]);
      value |= static_cast<std::uint64_t>(byte & 127U) << shift;
      if (byte < 128) break;
    }
    return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
  }

 private:
  std::string_view bytes_;
  std::size_t place_ = 0;
};

void read_coordinates(Reader& reader, std::vector<double>& values, Part part) {
  std::int64_t value = 0, slope = 0;
  for (std::size_t k = part.begin; k < part.end; ++k) {
    const std::int64_t difference = slope + reader.next_signed();
    value += difference;
    slope = k == part.begin ? 0 : difference;
    values[k] = static_cast<double>(value) * coordinate_step;
  }
}

std::string inflated(const std::string& stream) {
  z_stream state{};
  if (inflateInit(&state) != Z_OK) throw std::bad_alloc();
  state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stream.data()));
  state.avail_in = static_cast<uInt>(stream.size());
  std::string bytes;
  int result = Z_OK;
  while (result == Z_OK) {
    const std::size_t done = bytes.size();
    bytes.resize(done + (std::size_t{1} << 16U));
    state.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
    state.avail_out = static_cast<uInt>(bytes.size() - done);
    result = inflate(&state, Z_NO_FLUSH);
  }
  bytes.resize(state.total_out);
  inflateEnd(&state);
  assert(result == Z_STREAM_END);
  return bytes;
}

/// Of a track of so many frames.
int kept_frames(int frames, int every) { return frames < 2 ? frames : (frames - 2) / every + 2; }

/// The kept frame `k` as a frame of the track.
int frame_of(int k, int every, int frames) { return std::min(k * every, frames - 1); }

std::vector<Course> kept_courses(const Track& track, int every) {
  const int frames = track.frame_count(), kept = kept_frames(frames, every);
  std::vector<Course> courses(frames == 0 ? 0 : track.x.front().size());
  for (int k = 0; k < kept; ++k) {
    const auto f = static_cast<std::size_t>(frame_of(k, every, frames));
    for (std::size_t i = 0; i < courses.size(); ++i) {
      courses[i].x.push_back(track.x[f][i]);
      courses[i].y.push_back(track.y[f][i]);
    }
  }
  return courses;
}

TrackError error_of(const Track& track, const std::vector<Course>& courses, int every) {
  TrackError error;
  const int frames = track.frame_count();
  std::size_t far = 0;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    for (int f = 0; f < frames; ++f) {
      const auto at = static_cast<std::size_t>(f);
      const double distance = std::hypot(shown_at(courses[i].x, every, frames, f) - track.x[at][i],
                                         shown_at(courses[i].y, every, frames, f) - track.y[at][i]);
      error.worst = std::max(error.worst, distance);
      if (distance > picture_error) ++far;
    }
  }
  const std::size_t all = courses.size() * static_cast<std::size_t>(frames);
  if (all > 0) error.far_share = static_cast<double>(far) / static_cast<double>(all);
  return error;
}

}  // namespace

void append_varint(std::string& bytes, std::uint64_t value) {
  for (; value >= 128; value >>= 7U) bytes += static_cast<char>(128U | (value & 127U));
  bytes += static_cast<char>(value);
}

void append_signed(std::string& bytes, std::int64_t value) {
  append_varint(bytes, (static_cast<std::uint64_t>(value) << 1U) ^
                           (value < 0 ? ~std::uint64_t{0} : std::uint64_t{0}));
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string stream(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  stream.resize(size);
  return stream;
}

std::vector<std::string> pack(std::span<const Course> courses) {
  std::vector<std::string> chunks;
  for (int chunk = 0; chunk * chunk_frames < frames_of(courses); ++chunk) {
    std::string bytes;
    for (const Course& course : courses) {
      const Part part = part_in(course, chunk);
      append_coordinates(bytes, course.x, part);
      append_coordinates(bytes, course.y, part);
    }
    chunks.push_back(deflated(bytes));
  }
  return chunks;
}

void unpack(std::span<const std::string> chunks, std::vector<Course>& courses) {
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
    const std::string bytes = inflated(chunks[chunk]);
    Reader reader(bytes);
    for (Course& course : courses) {
      const Part part = part_in(course, static_cast<int>(chunk));
      read_coordinates(reader, course.x, part);
      read_coordinates(reader, course.y, part);
    }
  }
}

double shown_at(std::span<const double> kept, int every, int frames, double frame) {
  const int count = static_cast<int>(kept.size());
  if (count < 2) return kept.front();
  const auto time = [&](int k) { return static_cast<double>(frame_of(k, every, frames)); };
  const auto value = [&](int k) { return kept[static_cast<std::size_t>(k)]; };
  const int k = std::min(static_cast<int>(frame) / every, count - 2);
  const auto slope = [&](int at) {
    const int before = std::max(at - 1, 0), after = std::min(at + 1, count - 1);
    return (value(after) - value(before)) / (time(after) - time(before));
  };
  const double width = time(k + 1) - time(k), t = (frame - time(k)) / width;
  const double s = 1 - t;
  return s * s * ((1 + 2 * t) * value(k) + t * width * slope(k)) +
         t * t * ((1 + 2 * s) * value(k + 1) - s * width * slope(k + 1));
}

PackedTrack pack(const Track& track) {
  PackedTrack packed{track.interval, track.frame_count(), 1, {}};
  std::vector<Course> courses;
  for (const int every : {8, 6, 5, 4, 3, 2, 1}) {
    packed.every = every;
    courses = kept_courses(track, every);
    std::vector<Course> read = courses;
    for (Course& course : read) {
      for (double& x : course.x) x = static_cast<double>(rounded(x)) * coordinate_step;
      for (double& y : course.y) y = static_cast<double>(rounded(y)) * coordinate_step;
    }
    const TrackError error = error_of(track, read, every);
    if (error.far_share <= picture_far_share && error.worst <= picture_worst) break;
  }
  packed.chunks = pack(courses);
  return packed;
}

TrackError error_of(const Track& track, const PackedTrack& packed) {
  std::vector<Course> courses = kept_courses(track, packed.every);
  for (Course& course : courses) {  // what is not read must not look right
    std::fill(course.x.begin(), course.x.end(), 1e9);
    std::fill(course.y.begin(), course.y.end(), 1e9);
  }
  unpack(packed.chunks, courses);
  return error_of(track, courses, packed.every);
}

}  // namespace metamorph::evolve
