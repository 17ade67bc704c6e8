#include <cstdio>

#include "core/body.h"
#include "core/scene.h"
#include "core/status.h"

int main() {
  using namespace metamorph::core;
  if (water_scene().ground || name(Status::ok) != "ok") return 1;
  std::puts("consumer ran");
}
