#include "file/scene_file.hpp"

#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "file/collider_file.hpp"
#include "file/file_reader.hpp"
#include "file/file_writer.hpp"
#include "scene/invalid_pose.hpp"
#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The collider of an index without an instance.
constexpr std::uint32_t no_collider = ~std::uint32_t{0};
/// The size of the three counts after the head.
constexpr std::size_t counts_bytes = 3 * sizeof(std::uint32_t);
/// The size of a record of an instance: three numbers, the user's number, the pose and the motion.
template <typename Scalar>
constexpr std::size_t instance_bytes = 3 * sizeof(std::uint32_t) + sizeof(std::uint64_t) + 15 * sizeof(Scalar);

/// The colliders of a scene, each once.
template <typename Scalar>
class Colliders {
 public:
  explicit Colliders(const SceneState<Scalar>& scene) {
    for (const PendingInstance<Scalar>& instance : scene.pending) {
      if (!instance.is_there) continue;
      if (index_of_.emplace(address(instance), static_cast<std::uint32_t>(all_.size())).second) {
        all_.push_back(instance.mesh());
      }
    }
  }

  [[nodiscard]] const std::vector<InstanceMesh<Scalar>>& all() const { return all_; }
  [[nodiscard]] std::uint32_t index_of(const PendingInstance<Scalar>& instance) const {
    return instance.is_there ? index_of_.find(address(instance))->second : no_collider;
  }

 private:
  static const void* address(const PendingInstance<Scalar>& instance) {
    return instance.collider != nullptr ? static_cast<const void*>(instance.collider) : instance.float_collider;
  }

  std::vector<InstanceMesh<Scalar>> all_;
  std::unordered_map<const void*, std::uint32_t> index_of_;
};

/// Calls `use` with the state of a collider, of whichever Scalar it is.
template <typename Scalar, typename Use>
auto use_collider(const InstanceMesh<Scalar>& mesh, const Use& use) {
  return mesh.own != nullptr ? use(*mesh.own) : use(*mesh.floats);
}

/// Returns the indices that may be used again, as a commit leaves them.
template <typename Scalar>
std::vector<std::uint32_t> unused_after_commit(const SceneState<Scalar>& scene) {
  std::vector<std::uint32_t> unused = scene.unused;
  for (const std::uint32_t index : scene.changed) {
    if (scene.pending[index].is_removed() && scene.pending[index].has_next_generation()) unused.push_back(index);
  }
  return unused;
}

}  // namespace

template <typename Scalar>
bool save(const SceneState<Scalar>& state, const ByteSink& sink) {
  const Colliders<Scalar> colliders(state);
  const std::vector<std::uint32_t> unused = unused_after_commit(state);
  const auto saved_size = [](const InstanceMesh<Scalar>& mesh) {
    return use_collider(mesh, [](const auto& collider) { return saved_bytes(collider); });
  };
  std::uint64_t size = head_bytes + counts_bytes + checksum_bytes + state.pending.size() * instance_bytes<Scalar> +
                       unused.size() * sizeof(std::uint32_t);
  for (const InstanceMesh<Scalar>& mesh : colliders.all()) size += sizeof(std::uint64_t) + saved_size(mesh);

  FileWriter writer(sink);
  writer.write_head(FileKind::scene, sizeof(Scalar), size);
  writer.write(static_cast<std::uint32_t>(colliders.all().size()));
  writer.write(static_cast<std::uint32_t>(state.pending.size()));
  writer.write(static_cast<std::uint32_t>(unused.size()));
  for (const InstanceMesh<Scalar>& mesh : colliders.all()) {
    writer.write(saved_size(mesh));
    const auto append = [&](std::span<const std::byte> bytes) {
      writer.write_bytes(bytes);
      return true;
    };
    static_cast<void>(use_collider(mesh, [&](const auto& collider) { return save(collider, ByteSink(append)); }));
  }
  for (const PendingInstance<Scalar>& instance : state.pending) {
    // What a removed instance had is not kept.
    const PendingInstance<Scalar> none;
    const PendingInstance<Scalar>& kept = instance.is_there ? instance : none;
    writer.write(colliders.index_of(instance));
    writer.write(instance.generation);
    writer.write(kept.options.mask);
    writer.write(kept.options.user_data);
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) writer.write(kept.placement.pose.linear(row, column));
    }
    for (const Scalar number : kept.placement.pose.translation) writer.write(number);
    for (const Scalar number : kept.placement.motion) writer.write(number);
  }
  for (const std::uint32_t index : unused) writer.write(index);
  return writer.finish();
}

namespace {

/// Reads a scene.
template <typename Scalar>
class SceneReading {
 public:
  using Reason = InvalidFile::Reason;

  SceneReading(FileReader reader, const LoadOptions& options, SceneState<Scalar>& state)
      : reader_(reader), options_(options), state_(state) {}

  [[nodiscard]] std::optional<InvalidFile> read() {
    static_cast<void>(read_all());
    return std::move(error_);
  }

 private:
  /// A loaded collider. One pointer is null.
  struct Loaded {
    std::shared_ptr<const Collider<Scalar>> own;
    std::shared_ptr<const Collider<float>> floats;
    bool is_used = false;
  };

  bool fail(Reason reason, std::size_t offset, const std::string& message) {
    error_.emplace(reason, offset, "byte " + std::to_string(offset) + ": " + message);
    return false;
  }

  bool read_all() {
    const std::size_t offset = reader_.offset();
    if (reader_.left() < counts_bytes) return fail(Reason::wrong_size, offset, "the counts are missing");
    const auto colliders = reader_.take<std::uint32_t>();
    const auto instances = reader_.take<std::uint32_t>();
    const auto unused = reader_.take<std::uint32_t>();
    if (colliders > instances || unused > instances || instances >= InstanceTree::instance_bit ||
        !reader_.has(instances, instance_bytes<Scalar>)) {
      return fail(Reason::wrong_counts, offset, "the counts do not fit each other or the file");
    }
    for (std::uint32_t i = 0; i < colliders; ++i) {
      if (!read_collider()) return false;
    }
    if (reader_.left() != instances * instance_bytes<Scalar> + unused * sizeof(std::uint32_t)) {
      return fail(Reason::wrong_counts, reader_.offset(), "the instances do not fill the rest of the file");
    }
    state_.pending.resize(instances);
    state_.changed.reserve(instances);
    state_.unused.reserve(instances);
    for (std::uint32_t i = 0; i < instances; ++i) {
      if (!read_instance(i)) return false;
    }
    for (std::uint32_t i = 0; i < unused; ++i) {
      if (!read_unused()) return false;
    }
    return has_named_all();
  }

  bool read_collider() {
    const std::size_t offset = reader_.offset();
    if (!reader_.has(1, sizeof(std::uint64_t))) return fail(Reason::wrong_counts, offset, "colliders are missing");
    const std::size_t size = reader_.take_count();
    if (!reader_.has(size, 1)) return fail(Reason::wrong_counts, offset, "the collider does not fit into the file");
    const std::size_t base = reader_.offset();
    const std::span<const std::byte> bytes = reader_.take_bytes(size);
    if constexpr (std::is_same_v<Scalar, double>) {
      // The last byte of the head's first 16 has the size of a Scalar.
      constexpr std::size_t scalar_at = 15;
      if (bytes.size() > scalar_at && std::to_integer<std::size_t>(bytes[scalar_at]) == sizeof(float)) {
        return load_collider<float>(bytes, base, colliders_.emplace_back().floats);
      }
    }
    return load_collider<Scalar>(bytes, base, colliders_.emplace_back().own);
  }

  template <typename T>
  bool load_collider(std::span<const std::byte> bytes, std::size_t base, std::shared_ptr<const Collider<T>>& loaded) {
    auto collider = std::make_shared<Collider<T>>();
    error_ = ColliderState<T>::load_into(*collider, bytes, base, options_);
    loaded = std::move(collider);
    return !error_;
  }

  bool read_instance(std::uint32_t index) {
    const std::size_t offset = reader_.offset();
    const auto fault = [&](const std::string& message) {
      return fail(Reason::invalid_instance, offset, "instance " + std::to_string(index) + ": " + message);
    };
    PendingInstance<Scalar>& instance = state_.pending[index];
    const auto collider = reader_.take<std::uint32_t>();
    instance.generation = reader_.take<std::uint32_t>();
    instance.options.mask = reader_.take<std::uint32_t>();
    instance.options.user_data = reader_.take<std::uint64_t>();
    Pose<Scalar>& pose = instance.placement.pose;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) pose.linear(row, column) = reader_.take<Scalar>();
    }
    for (Scalar& number : pose.translation) number = reader_.take<Scalar>();
    Vector3<Scalar>& motion = instance.placement.motion;
    for (Scalar& number : motion) number = reader_.take<Scalar>();
    if (const auto invalid = find_invalid(pose)) return fault(invalid->what());
    if (!motion.allFinite()) return fault("its motion is not finite");
    instance.placement.moves = motion != Vector3<Scalar>::Zero();
    if (collider == no_collider) return true;
    if (!instance.has_next_generation()) return fault("its generation is the last one, which is for free indices");
    if (collider >= colliders_.size()) return fault("there is no collider " + std::to_string(collider));
    colliders_[collider].is_used = true;
    const Loaded& loaded = colliders_[collider];
    instance.collider = loaded.own.get();
    instance.float_collider = loaded.floats.get();
    if (loaded.own) {
      instance.share = loaded.own;
    } else {
      instance.share = loaded.floats;
    }
    instance.is_there = true;
    state_.note_change(index);
    ++state_.count;
    return true;
  }

  bool read_unused() {
    const std::size_t offset = reader_.offset();
    const auto index = reader_.take<std::uint32_t>();
    // `has_changed` marks those that are named, until all are read.
    if (index >= state_.pending.size() || state_.pending[index].has_changed) {
      return fail(Reason::invalid_instance, offset, "index " + std::to_string(index) + " is not free");
    }
    state_.pending[index].has_changed = true;
    state_.unused.push_back(index);
    return true;
  }

  /// Checks that each index is in use, or may be used again, or has used up its generations.
  bool has_named_all() {
    for (std::uint32_t i = 0; i < state_.pending.size(); ++i) {
      PendingInstance<Scalar>& instance = state_.pending[i];
      if (!instance.is_there && instance.has_changed != instance.has_next_generation()) {
        return fail(Reason::invalid_instance, reader_.offset(), "index " + std::to_string(i) + " is lost");
      }
      if (!instance.is_there) instance.has_changed = false;
    }
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
      if (colliders_[i].is_used) continue;
      return fail(Reason::invalid_instance, reader_.offset(), "no instance has collider " + std::to_string(i));
    }
    return true;
  }

  FileReader reader_;
  const LoadOptions& options_;
  SceneState<Scalar>& state_;
  std::vector<Loaded> colliders_;
  std::optional<InvalidFile> error_;
};

}  // namespace

template <typename Scalar>
std::optional<InvalidFile> load(std::span<const std::byte> bytes, const LoadOptions& options, SceneState<Scalar>& state,
                                CommittedShare<Scalar>& committed) {
  if (auto invalid = find_invalid_head(bytes, FileKind::scene, sizeof(Scalar))) return invalid;
  if (auto invalid = SceneReading<Scalar>(body_of(bytes), options, state).read()) return invalid;
  state.commit(committed, address_of(options.executor));
  return std::nullopt;
}

template bool save(const SceneState<float>&, const ByteSink&);
template bool save(const SceneState<double>&, const ByteSink&);
template std::optional<InvalidFile> load(std::span<const std::byte>, const LoadOptions&, SceneState<float>&,
                                         CommittedShare<float>&);
template std::optional<InvalidFile> load(std::span<const std::byte>, const LoadOptions&, SceneState<double>&,
                                         CommittedShare<double>&);

}  // namespace surehit::detail
