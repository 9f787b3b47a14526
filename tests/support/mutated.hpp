#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "support/random.hpp"

namespace surehit::test {

/// The bytes with a few of them changed, removed, doubled or cut off.
inline std::string mutated(std::string bytes, Random& random) {
  for (std::uint64_t changes = 1 + random.below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random.below(bytes.size());
    const std::size_t length = random.below(1 + std::min<std::size_t>(bytes.size() - at, 12));
    switch (random.below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random.bits());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
        break;
      case 2:
        bytes[at] = "0123456789-+.eE #/\\\n"[random.below(20)];
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(at, length));
        break;
      default:
        if (random.one_in(4)) bytes.resize(at);
        break;
    }
  }
  return bytes;
}

}  // namespace surehit::test
