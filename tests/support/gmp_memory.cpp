#include <gmp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

// The memory of GMP's numbers in tests. Oracles make and forget millions of small ones, so a thread keeps what it frees
// for its next ones. GMP says how large a block is that it frees, so a block needs no header. Sanitizers no longer see
// who uses these numbers after they are freed, nor who loses them.

namespace {

constexpr std::size_t step = 32;        // bytes
constexpr std::size_t lists = 17;       // Larger blocks come from malloc.
constexpr std::size_t chunk = 1 << 14;  // bytes, of which blocks of one size are made

struct FreeBlock {
  FreeBlock* next;
};

/// The first free block of each size. The size of a block is its index times `step`.
thread_local FreeBlock* free_blocks[lists];

/// All chunks, so that LeakSanitizer finds them. They are kept until the program ends.
std::atomic<FreeBlock*> chunks;

std::size_t list_of(std::size_t bytes) { return (std::max(bytes, std::size_t{1}) + step - 1) / step; }

void* or_abort(void* memory) {
  if (memory == nullptr) std::abort();  // GMP can do nothing else.
  return memory;
}

void put_back(void* memory, std::size_t list) { free_blocks[list] = new (memory) FreeBlock{free_blocks[list]}; }

/// Makes free blocks of a chunk, and returns one more.
[[gnu::noinline]] void* part_chunk(std::size_t list) {
  auto* const memory = static_cast<std::byte*>(or_abort(std::malloc(chunk)));
  auto* const head = new (memory) FreeBlock{chunks.load()};
  while (!chunks.compare_exchange_weak(head->next, head)) {
  }
  const std::size_t block = list * step;
  const std::size_t count = (chunk - step) / block;
  for (std::size_t i = 1; i < count; ++i) put_back(memory + step + i * block, list);
  return memory + step;
}

void* allocate(std::size_t bytes) {
  const std::size_t list = list_of(bytes);
  if (list >= lists) return or_abort(std::malloc(bytes));
  FreeBlock* const first = free_blocks[list];
  if (first == nullptr) return part_chunk(list);
  free_blocks[list] = first->next;
  return first;
}

void release(void* memory, std::size_t bytes) {
  const std::size_t list = list_of(bytes);
  if (list >= lists) return std::free(memory);
  put_back(memory, list);
}

void* reallocate(void* memory, std::size_t bytes, std::size_t new_bytes) {
  const std::size_t list = list_of(bytes);
  const std::size_t new_list = list_of(new_bytes);
  if (list >= lists && new_list >= lists) return or_abort(std::realloc(memory, new_bytes));
  if (list == new_list) return memory;
  void* const moved = allocate(new_bytes);
  std::memcpy(moved, memory, std::min(bytes, new_bytes));
  release(memory, bytes);
  return moved;
}

/// Runs before all other constructors, because a number is freed by the functions that have allocated it.
[[gnu::constructor(101)]] void give_memory_to_gmp() { mp_set_memory_functions(allocate, reallocate, release); }

}  // namespace
