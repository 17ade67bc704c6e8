#include <cstdio>

#include "metamorph/body.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"

int main() {
  using namespace metamorph::core;
  if (water_scene().ground || name(Status::ok) != "ok") return 1;
  std::puts("consumer ran");
}
