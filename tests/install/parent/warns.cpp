#include <metamorph/locomotion.h>

int warns() {
  int unused;  // a warning, which is this project's affair
  return 0;
}
