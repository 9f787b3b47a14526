#include "report.hpp"

#include <cstdio>

namespace surehit::benchmark {

void Report::show(const std::string& title, const MarkdownTable& table) const {
  std::printf("## %s (surehit on %s)\n\n%s\n", title.c_str(), instruction_set_.c_str(), table.text().c_str());
  std::fflush(stdout);
}

std::string Report::csv() const {
  std::string text = "instruction_set,table,mesh,triangles,paths,question,contender,measure,median,min,max\n";
  for (const Record& record : records_) {
    char figures[120];
    std::snprintf(figures, sizeof figures, "%.6g,%.6g,%.6g", record.figure.median, record.figure.least,
                  record.figure.greatest);
    const Place& place = record.place;
    text += instruction_set_ + ',' + place.table + ',' + place.mesh + ',' + std::to_string(place.triangles) + ',' +
            place.paths + ',' + place.question + ',' + record.contender + ',' + record.measure + ',' + figures + '\n';
  }
  return text;
}

}  // namespace surehit::benchmark
