// Body files: what is read is sound, and comes back when it was written.

#include "evolve/files/body_file.h"

#include "tests/fuzz/contract.h"

using namespace metamorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  core::Body body;
  if (!fuzz::is_taken("body",
                      [&] { body = evolve::parse_body(fuzz::text_of(data, size), "body"); }))
    return 0;
  fuzz::require(core::check(body).empty(), "a body that is read is sound");
  const std::string text = evolve::body_text(body);
  const core::Body back = evolve::parse_body(text, "written");
  fuzz::require(back.x == body.x && back.y == body.y && back.period == body.period &&
                    back.phase == body.phase && back.triangles == body.triangles &&
                    back.springs == body.springs && back.rest_length == body.rest_length &&
                    back.rest_area == body.rest_area && evolve::body_text(back) == text,
                "a body comes back", text);
  return 0;
}
