#include "surehit_query/number_table.hpp"

#include <algorithm>

#include "command_line/progress_bar.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/read_file.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

template <typename Scalar>
NumberTable<Scalar> parse_number_table(std::string_view text, std::size_t columns,
                                       const std::function<void(const Scalar*)>& check) {
  NumberTable<Scalar> table{columns, {}};
  TextLines lines(text);
  ProgressBar progress("Reading", text.size());
  std::vector<std::string_view> part;
  std::vector<std::string_view> fields;
  naming_the_line(lines, [&] {
    while (lines.next()) {
      progress.show(text.size() - lines.rest().size());
      const std::size_t first = lines.line().find_first_not_of(white_space);
      if (first == std::string_view::npos || lines.line()[first] == '#') continue;
      split_at_commas(lines.line(), part, fields);
      if (fields.size() != columns) {
        throw InputError("expected " + std::to_string(columns) + " numbers, not " + std::to_string(fields.size()));
      }
      for (const std::string_view field : fields) table.numbers.push_back(parse_number<Scalar>(field));
      if (check) check(table.row(table.rows() - 1));
    }
  });
  return table;
}

}  // namespace

void split_at_commas(std::string_view line, std::vector<std::string_view>& part,
                     std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    split(line.substr(begin, end - begin), part);
    if (part.empty()) throw InputError("a number is missing beside a comma");
    fields.insert(fields.end(), part.begin(), part.end());
    begin = end + 1;
  }
}

template <typename Scalar>
NumberTable<Scalar> read_number_table(const std::string& path, std::size_t columns,
                                      const std::function<void(const Scalar*)>& check) {
  try {
    return parse_number_table<Scalar>(read_file(path), columns, check);
  } catch (const InputError& error) {
    throw error.at(path == "-" ? "standard input" : path);
  }
}

template NumberTable<float> read_number_table<float>(const std::string&, std::size_t,
                                                     const std::function<void(const float*)>&);
template NumberTable<double> read_number_table<double>(const std::string&, std::size_t,
                                                       const std::function<void(const double*)>&);

}  // namespace surehit::example
