#include "textbook_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <vector>

#include "support/exact_oracle.hpp"
#include "textbook_examples.hpp"
#include "variant_judge.hpp"

namespace surehit::test {
namespace {

/// With commas between thousands.
std::string counted(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

template <typename... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  std::array<char, 64> text = {};
  std::snprintf(text.data(), text.size(), format, numbers...);
  return text.data();
}

std::string in_ulps(double ulps) {
  if (std::isinf(ulps)) return "∞";
  return ulps < 10 ? formatted("%.2g", ulps) : ulps < 1e4 ? formatted("%.0f", ulps) : formatted("%.0e", ulps);
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += ' ' + cell + " |";
  return text + '\n';
}

std::string head(const std::vector<std::string>& cells) {
  return row(cells) + row(std::vector<std::string>(cells.size(), "---"));
}

template <typename Scalar>
struct Judgement {
  std::array<Tallies, all_pair_families.size()> families;
  Tallies all;
  std::array<std::size_t, textbook_variant_count> leaks;

  Judgement() : leaks(count_leaks<Scalar>()) {
    for (std::size_t i = 0; i < families.size(); ++i) {
      families[i] = judge_family<Scalar>(all_pair_families[i]);
      for (std::size_t variant = 0; variant < all.size(); ++variant) all[variant].add(families[i][variant]);
    }
  }
};

/// A row for each family, and a column for each variant.
template <typename Cell>
std::string by_family(const std::array<Tallies, all_pair_families.size()>& families, Cell cell) {
  std::vector<std::string> letters = {"family"};
  for (const auto& variant : textbook_variants<float>()) letters.emplace_back(variant.letter);
  std::string table = head(letters);
  for (std::size_t i = 0; i < families.size(); ++i) {
    std::string name = name_of(all_pair_families[i]);
    std::ranges::replace(name, '_', ' ');
    std::vector<std::string> cells = {name};
    for (const Tally& tally : families[i]) cells.push_back(cell(tally));
    table += row(cells);
  }
  return table;
}

template <typename Scalar>
std::string decisions(const Judgement<Scalar>& judgement) {
  return by_family(judgement.families, [](const Tally& tally) {
    if (tally.false_hits + tally.missed == 0) return std::string("0");
    return counted(tally.false_hits) + " / " + counted(tally.missed);
  });
}

template <typename Scalar>
std::string errors(const Judgement<Scalar>& judgement) {
  return by_family(judgement.families, [](const Tally& tally) {
    if (tally.hits == 0 || tally.missed == tally.hits) return std::string("–");
    const auto [t, u, v] = tally.worst_errors;
    return in_ulps(t) + ' ' + in_ulps(u) + ' ' + in_ulps(v);
  });
}

std::string summary(const Judgement<float>& in_float, const Judgement<double>& in_double) {
  std::string table =
      head({"", "test", "float: false hits", "missed", "leaks", "double: false hits", "missed", "leaks"});
  for (std::size_t i = 0; i < textbook_variant_count; ++i) {
    const auto& variant = textbook_variants<float>()[i];
    std::vector<std::string> cells = {i == 0 ? "" : variant.letter, variant.name};
    const auto add = [&](const auto& judgement) {
      for (const std::size_t count : {judgement.all[i].false_hits, judgement.all[i].missed, judgement.leaks[i]}) {
        cells.push_back(counted(count));
      }
    };
    add(in_float);
    add(in_double);
    table += row(cells);
  }
  return table;
}

/// The lines for those who read no more.
std::string lines(const Judgement<float>& in_float, const Judgement<double>& in_double) {
  std::string table =
      head({"float / double", "wrong of " + counted(judged_pairs * all_pair_families.size()) + " hard pairs",
            "pass between two triangles, of " + counted(judged_pairs)});
  for (std::size_t i = 0; i < textbook_variant_count; ++i) {
    const std::string letter = textbook_variants<float>()[i].letter;
    if (letter != "b" && letter != "h") continue;
    const auto wrong = [&](const auto& judgement) {
      return counted(judgement.all[i].false_hits + judgement.all[i].missed);
    };
    table += row({letter == "b" ? "Möller and Trumbore 1997" : "Woop, Benthin and Wald 2013, watertight",
                  wrong(in_float) + " / " + wrong(in_double),
                  counted(in_float.leaks[i]) + " / " + counted(in_double.leaks[i])});
  }
  return table;
}

/// A whole number, or one part of a power of two.
std::string text_of(float x) {
  if (x == 0 || std::abs(x) >= 1) return formatted("%.0f", static_cast<double>(x));
  return (x < 0 ? "-1/" : "1/") + formatted("%.0f", 1 / std::abs(static_cast<double>(x)));
}

std::string text_of(const Vector3f& point) {
  return text_of(point[0]) + ", " + text_of(point[1]) + ", " + text_of(point[2]);
}

std::string text_of(const TextbookAnswer<float>& answer) {
  if (!answer) return "no hit";
  return std::isnan(answer->t) ? "hit, t = NaN" : "hit, t = " + formatted("%.9g", static_cast<double>(answer->t));
}

std::string examples() {
  std::string table = head({"", "a", "b", "c", "path", "exactly", "it says"});
  for (const auto& [letter, triangle, path] : textbook_examples()) {
    const auto& variant = textbook_variant<float>(letter);
    std::optional<ExactContact> contact = exact_contact(path, triangle);
    if (contact && variant.asked == Asked::front && contact->side != Side::front) contact.reset();
    const std::string way = path.kind == PathKind::segment ? " to " : " along ";
    table += row({letter, text_of(triangle.a), text_of(triangle.b), text_of(triangle.c),
                  text_of(path.start) + way + text_of(path.toward),
                  contact ? "hit, t = " + contact->t.get_str() : "no hit", text_of(variant.answer(path, triangle))});
  }
  return table;
}

}  // namespace

std::map<std::string, std::string> textbook_blocks() {
  const Judgement<float> in_float;
  const Judgement<double> in_double;
  return {{"lines", lines(in_float, in_double)},
          {"summary", summary(in_float, in_double)},
          {"examples", examples()},
          {"decisions_float", decisions(in_float)},
          {"decisions_double", decisions(in_double)},
          {"errors_float", errors(in_float)},
          {"errors_double", errors(in_double)}};
}

std::string with_textbook_blocks(const std::string& page, const std::map<std::string, std::string>& blocks) {
  static const std::string begin = "<!-- textbook: ";
  static const std::string end = "<!-- end -->";
  std::string renewed;
  std::size_t place = 0;
  for (std::size_t found = page.find(begin); found != std::string::npos; found = page.find(begin, place)) {
    const std::size_t name_begin = found + begin.size();
    const std::size_t name_end = page.find(" -->", name_begin);
    const std::size_t block_end = page.find(end, name_begin);
    if (block_end == std::string::npos || name_end > block_end) throw std::runtime_error("a marker has no end");
    const std::string name = page.substr(name_begin, name_end - name_begin);
    const auto block = blocks.find(name);
    if (block == blocks.end()) throw std::runtime_error("there is no block '" + name + "'");
    renewed += page.substr(place, name_end - place) + " -->\n\n" + block->second + '\n' + end;
    place = block_end + end.size();
  }
  if (place == 0) throw std::runtime_error("the page has no markers");
  return renewed + page.substr(place);
}

}  // namespace surehit::test
