#include "mesh_io/byte_reader.hpp"

#include "mesh_io/input_error.hpp"

namespace surehit::example {

std::string_view ByteReader::take_bytes(std::uint64_t count) {
  if (rest_.size() < count) throw InputError("the file ends too early");
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

}  // namespace surehit::example
