#include "moving_platforms/hall_scene.hpp"

#include "level/room.hpp"

namespace surehit::example {
namespace {

std::shared_ptr<const Colliderf> collider_of(const Mesh<float>& mesh) {
  return std::make_shared<const Colliderf>(mesh.view());
}

/// The user data of the room. Below it are indices of platforms, and then of fans.
constexpr std::uint64_t room_data = ~std::uint64_t{0};

}  // namespace

HallScene::HallScene(const Hall& hall, Stepping stepping) : hall_(hall), stepping_(stepping), turns_(hall.fans.size()) {
  const auto point = [](const Vector3f& p) -> Point { return {p.x(), p.y(), p.z()}; };
  const auto room = collider_of(build_room(point(hall.room.low), point(hall.room.high), {1, 1, 1}));
  scene_.add(room, {}, {.user_data = room_data});
  std::uint64_t user_data = 0;
  for (const Platform& platform : hall.platforms) {
    const Posef pose = Posef::translated(platform.position(0));
    platforms_.push_back(scene_.add(collider_of(platform.mesh()), pose, {.user_data = user_data++}));
  }
  for (std::size_t i = 0; i < hall.fans.size(); ++i) {
    const Fan& fan = hall.fans[i];
    fans_.push_back(scene_.add(collider_of(fan.mesh()), turns_[i].pose(fan), {.user_data = user_data++}));
  }
}

void HallScene::next_step(const std::optional<Executor>& executor) {
  const std::uint32_t step = steps_begun_++;
  for (std::size_t i = 0; i < platforms_.size(); ++i) {
    const Platform& platform = hall_.platforms[i];
    scene_.set_pose(platforms_[i], Posef::translated(platform.position(step)));
    if (stepping_ == Stepping::by_motion) scene_.set_motion(platforms_[i], platform.motion(step));
  }
  for (std::size_t i = 0; i < fans_.size(); ++i) {
    scene_.set_pose(fans_[i], turns_[i].pose(hall_.fans[i]));
    turns_[i].advance(hall_.fans[i]);
  }
  scene_.commit(executor);
}

Vector3f HallScene::motion_at(InstanceId id, const Vector3f& point) const {
  const std::uint64_t index = scene_.user_data(id);
  if (index == room_data) return Vector3f::Zero();
  if (index < hall_.platforms.size()) return hall_.platforms[index].motion(steps_begun_ - 1);
  return hall_.fans[index - hall_.platforms.size()].motion_at(point);
}

}  // namespace surehit::example
