#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/PictureFile.h"
#include "validation/compare/CompareRecord.h"

namespace tessera::validation {

struct ReportPicture {
    std::string name;    ///< what the pairs call it, such as "forward"
    std::string caption; ///< one line below it; may be empty
    Png image;
};

/// The heat map of one pair; names as in ComparePair.
struct ReportHeatMap {
    std::string a, b;
    Png image;
};

struct ReportFact {
    std::string label, value; ///< such as "Triangles", "212,480"
};

struct ReportPlan {
    std::string technique;
    std::string text; ///< as `tessera plan` prints it
};

/// The parts of a page that tell a benchmark, as HTML (validation/bench/BenchHtml.h).
struct ReportBench {
    std::string answer;   ///< below the title: which technique, how much faster, at what error
    std::string sections; ///< plots and tables
};

/// The contents of a report. Texts are plain: characters with a meaning in HTML are escaped.
struct Report {
    std::string title;    ///< such as "hall, rendered four ways"
    CompareRecord record; ///< scene, size, renderer and the pairs, of which there may be none beside a bench
    std::optional<ReportBench> bench;
    std::string choice;            ///< which technique to take here and why, one plain sentence; may be empty
    std::vector<ReportFact> facts; ///< shown below the title
    std::vector<ReportPicture> pictures;
    std::vector<ReportHeatMap> heatMaps;
    std::vector<ReportPlan> plans;
    std::vector<std::string> commands; ///< each reproduces a part of the page
};

/// One page of HTML that needs nothing else: pictures, style and script are inside, and nothing is fetched. A pair
/// whose two pictures are both given gets a before/after slider; without script the pictures still show. Write it with
/// writeFileAtomically().
std::string reportHtml(const Report& report);

} // namespace tessera::validation
