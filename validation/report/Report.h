#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/PictureFile.h"
#include "validation/compare/CompareRecord.h"

namespace tessera::validation {

struct ReportPicture {
    std::string name;    ///< its name in pairs, such as "forward"
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

/// A benchmark's parts of a page, as HTML (validation/bench/BenchHtml.h).
struct ReportBench {
    std::string answer;   ///< below the title: which technique, how much faster, at what error
    std::string sections; ///< plots and tables
};

/// The contents of a report. Texts are plain: characters with a meaning in HTML are escaped.
struct Report {
    std::string title;    ///< such as "hall, rendered four ways"
    CompareRecord record; ///< scene, size, renderer and pairs; a bench may have no pairs
    std::optional<ReportBench> bench;
    std::string choice;            ///< which technique to take here and why, one plain sentence; may be empty
    std::vector<ReportFact> facts; ///< shown below the title
    std::vector<ReportPicture> pictures;
    std::vector<ReportHeatMap> heatMaps;
    std::vector<ReportPlan> plans;
    std::vector<std::string> commands; ///< each reproduces a part of the page
};

/// A self-contained HTML page with embedded images, style and script. A pair with both of its images gets a
/// before/after slider; without scripts the images still show. Write it with writeFileAtomically().
std::string reportHtml(const Report& report);

} // namespace tessera::validation
