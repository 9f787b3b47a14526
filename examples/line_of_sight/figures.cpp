#include "line_of_sight/figures.hpp"

#include <algorithm>
#include <sstream>

namespace surehit::example {

void Figures::count(const std::vector<Sight>& sights) {
  const auto how_many = [&](Sight sight) {
    return static_cast<std::size_t>(std::count(sights.begin(), sights.end(), sight));
  };
  visible = how_many(Sight::visible);
  hidden = how_many(Sight::hidden);
  without_floor = how_many(Sight::no_floor);
  points = visible + hidden;
}

std::string Figures::csv() const {
  std::ostringstream text;
  text << "triangles,points,visible,hidden,without_floor,threads,build_seconds,floor_seconds,sight_seconds,"
          "segments_per_second\n"
       << triangles << ',' << points << ',' << visible << ',' << hidden << ',' << without_floor << ',' << threads << ','
       << build_seconds << ',' << floor_seconds << ',' << sight_seconds << ','
       << static_cast<std::size_t>(segments_per_second()) << '\n';
  return text.str();
}

}  // namespace surehit::example
