#include "visibility_bake/pair_plan.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace surehit::example {
namespace {

/// Mixes the bits of a number, so that neighbours have nothing in common.
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  return bits ^ bits >> 31;
}

/// A share in [0, 1) from 16 of 64 mixed bits.
float share_of(std::uint64_t bits, int part) { return static_cast<float>(bits >> (16 * part) & 0xffff) / 0x1p16f; }

/// FNV-1a over whole numbers.
class Fingerprint {
 public:
  void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ (number >> shift & 255)) * 0x100000001b3u;
  }
  void add(const Vector3f& point) {
    for (const float coordinate : {point.x(), point.y(), point.z()}) add(std::bit_cast<std::uint32_t>(coordinate));
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// The middle eye of a cell. Below a ceiling or another floor that is too low, it is at the last free point above its
/// own floor.
Vector3f middle_eye(const Colliderf& collider, const Vector3f& floor, float eye_height) {
  // The floor's height is rounded, so the way begins a little above it.
  const Segmentf way{floor + Vector3f(0, 0, eye_height / 256), floor + Vector3f(0, 0, eye_height)};
  const auto hit = collider.first_hit(way);
  return hit ? collider.last_free_point(way, *hit) : way.end;
}

}  // namespace

PairPlan::PairPlan(const Colliderf& collider, std::vector<Vector3f> floors, const PairOptions& options)
    : floors_(std::move(floors)), options_(options), by_y_(floors_.size()) {
  std::iota(by_y_.begin(), by_y_.end(), 0u);
  std::ranges::stable_sort(by_y_, {}, [&](std::uint32_t cell) { return floors_[cell].y(); });
  for (std::uint32_t cell = 0; cell < cell_count(); ++cell) {
    const Vector3f middle = middle_eye(collider, floors_[cell], options.eye_height);
    const bool is_lowered = middle != floors_[cell] + Vector3f(0, 0, options.eye_height);
    const float height = is_lowered ? middle.z() - floors_[cell].z() : options.eye_height;
    eyes_.push_back(middle);
    for (std::uint32_t number = 1; number < eyes_of_a_cell; ++number) {
      const std::uint64_t bits = mixed(std::uint64_t{cell} * eyes_of_a_cell + number);
      const Vector3f offset((share_of(bits, 0) - 0.5f) * options.cell_width,
                            (share_of(bits, 1) - 0.5f) * options.cell_width,
                            (0.25f + 0.75f * share_of(bits, 2)) * height);
      const Vector3f eye = floors_[cell] + offset;
      eyes_.push_back(collider.any_hit(Segmentf{middle, eye}) ? middle : eye);
    }
  }
}

std::vector<std::uint32_t> PairPlan::partners(std::uint32_t cell) const {
  const Vector3f& floor = floors_[cell];
  // Rounding makes a difference by less than this too long.
  const float reach = 1.001f * options_.range;
  const auto y_of = [&](std::uint32_t other) { return floors_[other].y(); };
  const auto begin = std::ranges::lower_bound(by_y_, floor.y() - reach, {}, y_of);
  const auto end = std::ranges::upper_bound(by_y_, floor.y() + reach, {}, y_of);
  std::vector<std::uint32_t> partners;
  for (auto at = begin; at != end; ++at) {
    const std::uint32_t other = *at;
    // If the numbers of two cells have the same parity, the higher one has the pair. Otherwise the lower one has it.
    const bool is_mine = (other > cell) == ((cell ^ other) % 2 != 0) && other != cell;
    if (!is_mine) continue;
    if ((floors_[other] - floor).squaredNorm() <= options_.range * options_.range) partners.push_back(other);
  }
  return partners;
}

Segmentf PairPlan::segment(std::uint32_t cell, std::uint32_t partner, std::uint32_t sample) const {
  const std::uint64_t bits = mixed(std::uint64_t{cell} << 32 | partner);
  const auto from = static_cast<std::uint32_t>((bits + sample) % eyes_of_a_cell);
  // Each round through the eyes of the cell meets other eyes of the partner.
  const auto to = static_cast<std::uint32_t>(((bits >> 32) + sample + sample / eyes_of_a_cell) % eyes_of_a_cell);
  return {eye(cell, from), eye(partner, to)};
}

std::uint64_t PairPlan::fingerprint(const Colliderf& collider) const {
  Fingerprint fingerprint;
  fingerprint.add(collider.triangle_count());
  for (std::uint32_t i = 0; i < collider.triangle_count(); ++i) {
    const Trianglef triangle = collider.triangle(i);
    for (const Vector3f& corner : {triangle.a, triangle.b, triangle.c}) fingerprint.add(corner);
  }
  fingerprint.add(floors_.size());
  for (const Vector3f& floor : floors_) fingerprint.add(floor);
  fingerprint.add(options_.samples);
  for (const float number : {options_.range, options_.cell_width, options_.eye_height}) {
    fingerprint.add(std::bit_cast<std::uint32_t>(number));
  }
  return fingerprint.hash();
}

}  // namespace surehit::example
