#include "visibility_bake/checked_bytes.hpp"

#include <zlib.h>

#include <stdexcept>

#include "mesh_io/byte_reader.hpp"
#include "mesh_io/input_error.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t checksum_bytes = 4;

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

std::string ByteWriter::finish() {
  add(checksum(bytes_), checksum_bytes);
  return std::move(bytes_);
}

std::string_view checked_content(std::string_view file, std::string_view title) {
  if (!file.starts_with(title)) throw InputError("is not a file of this kind");
  const std::size_t end = file.size() - std::min(file.size(), checksum_bytes);
  if (end < title.size()) throw InputError("is damaged: it ends too early");
  ByteReader sum(file.substr(end), std::endian::little);
  if (sum.take<std::uint32_t>() != checksum(file.substr(0, end))) {
    throw InputError("is damaged: its checksum is not that of its bytes");
  }
  return file.substr(title.size(), end - title.size());
}

std::string compressed_bytes(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::runtime_error("zlib cannot compress " + std::to_string(bytes.size()) + " bytes");
  }
  result.resize(size);
  return result;
}

std::string decompressed_bytes(std::string_view bytes, std::size_t size) {
  std::string result(size, '\0');
  uLongf written = static_cast<uLongf>(size);
  if (uncompress(reinterpret_cast<Bytef*>(result.data()), &written, reinterpret_cast<const Bytef*>(bytes.data()),
                 static_cast<uLong>(bytes.size())) != Z_OK ||
      written != size) {
    throw InputError("is damaged: its compressed bytes are not those of a bit matrix of this size");
  }
  return result;
}

}  // namespace surehit::example
