#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace surehit::example {

/// What is wrong with input, in one line that names the place: "level.obj: line 12: a face needs 3 corners or more, not
/// 2".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  /// The same error with a place before it: the file, the line or the element.
  [[nodiscard]] InputError at(std::string_view place) const;
};

/// Text from a file, made fit for one line of a message: cut when long, without unprintable bytes.
[[nodiscard]] std::string printable(std::string_view text);
/// The same in quotes.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace surehit::example
