#include <surehit/surehit.hpp>

int main() {
  const float vertices[] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
  const int triangle[] = {0, 1, 2};
  const surehit::Colliderf collider(surehit::TriangleMeshViewf(vertices, triangle));
  return collider.any_hit(surehit::Segmentf{{1, 1, 1}, {1, 1, -1}}) ? 0 : 1;
}
