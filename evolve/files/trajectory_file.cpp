#include "evolve/files/trajectory_file.h"

#include "evolve/files/json_text.h"

namespace metamorph::evolve {

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& file, Overwrite overwrite)
    : output_(file, overwrite) {
  output_.write("step,time,node,x,y,vx,vy\n");
}

void TrajectoryWriter::write(const core::Frame& frame) {
  std::string start = std::to_string(frame.step) + ',';
  detail::append_number(start, frame.time);
  text_.clear();
  for (std::size_t node = 0; node < frame.x.size(); ++node) {
    text_.append(start).append(",").append(std::to_string(node));
    for (const double value : {frame.x[node], frame.y[node], frame.vx[node], frame.vy[node]}) {
      text_ += ',';
      detail::append_number(text_, value);
    }
    text_ += '\n';
  }
  output_.write(text_);
}

}  // namespace metamorph::evolve
