#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "c/handle.hpp"
#include "c_functions.hpp"

namespace surehit::test::c_handle_test {
namespace {

surehit_colliderf* empty_collider() {
  surehit_colliderf* handle = nullptr;
  EXPECT_EQ(surehit_colliderf_create(nullptr, nullptr, &handle), SUREHIT_OK);
  return handle;
}

TEST(CHandle, tells_that_it_was_closed) {
  surehit_colliderf* const handle = empty_collider();
  EXPECT_EQ(surehit_colliderf_destroy(handle), SUREHIT_OK);
  std::size_t count = 0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(surehit_colliderf_triangle_count(handle, &count), SUREHIT_INVALID_HANDLE) << i;
    EXPECT_EQ(surehit_colliderf_destroy(handle), SUREHIT_INVALID_HANDLE) << i;
    EXPECT_EQ(surehit_colliderf_destroy(empty_collider()), SUREHIT_OK);
  }
  EXPECT_NE(std::strstr(surehit_last_error(), "surehit_colliderf_destroy: collider was destroyed"), nullptr);
}

TEST(CHandle, tells_that_it_is_of_another_kind) {
  surehit_colliderf* const floats = empty_collider();
  std::size_t count = 0;
  EXPECT_EQ(surehit_colliderd_triangle_count(reinterpret_cast<surehit_colliderd*>(floats), &count),
            SUREHIT_INVALID_HANDLE);
  EXPECT_EQ(surehit_scenef_destroy(reinterpret_cast<surehit_scenef*>(floats)), SUREHIT_INVALID_HANDLE);
  EXPECT_EQ(surehit_scened_destroy(reinterpret_cast<surehit_scened*>(floats)), SUREHIT_INVALID_HANDLE);
  surehit_scenef* scene = nullptr;
  EXPECT_EQ(surehit_scenef_create(&scene), SUREHIT_OK);
  EXPECT_EQ(surehit_colliderf_destroy(reinterpret_cast<surehit_colliderf*>(scene)), SUREHIT_INVALID_HANDLE);
  surehit_instance_id id;
  EXPECT_EQ(surehit_scenef_add(scene, reinterpret_cast<surehit_colliderf*>(scene), nullptr, 1, 0, &id),
            SUREHIT_INVALID_HANDLE);
  EXPECT_EQ(surehit_scenef_destroy(scene), SUREHIT_OK);
  EXPECT_EQ(surehit_colliderf_destroy(floats), SUREHIT_OK);
}

// A program that makes and destroys colliders for ever does not grow for ever.
TEST(CHandle, is_used_again_after_many_others) {
  std::set<surehit_colliderf*> seen;
  for (int i = 0; i < 5000; ++i) {
    surehit_colliderf* const handle = empty_collider();
    seen.insert(handle);
    EXPECT_EQ(surehit_colliderf_destroy(handle), SUREHIT_OK);
  }
  EXPECT_GE(seen.size(), 1000U);
  EXPECT_LE(seen.size(), 1002U);
}

TEST(CHandle, frees_its_object) {
  const auto object = std::make_shared<Collider<float>>();
  c::Handle* const handle = c::Handle::open(object);
  EXPECT_EQ(handle->get<Collider<float>>(), object.get());
  EXPECT_EQ(handle->share<Collider<float>>(), object);
  EXPECT_EQ(object.use_count(), 2);
  handle->close();
  EXPECT_EQ(object.use_count(), 1);
  EXPECT_EQ(handle->get<Collider<float>>(), nullptr);
}

TEST(CHandle, is_opened_and_closed_on_many_threads) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([] {
      for (int j = 0; j < 2000; ++j) {
        std::vector<surehit_colliderf*> handles;
        for (int k = 0; k < 3; ++k) handles.push_back(empty_collider());
        EXPECT_EQ(std::set<surehit_colliderf*>(handles.begin(), handles.end()).size(), 3U);
        for (surehit_colliderf* const handle : handles) EXPECT_EQ(surehit_colliderf_destroy(handle), SUREHIT_OK);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace surehit::test::c_handle_test
