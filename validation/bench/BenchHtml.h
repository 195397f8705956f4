#pragma once
#include <functional>
#include <string>
#include <vector>

#include "validation/bench/BenchRecord.h"
#include "validation/report/Report.h"

namespace tessera::validation {

/// Returns the bytes of a kept image, given its file name.
using PictureBytes = std::function<std::vector<std::uint8_t>(const std::string& file)>;

/// The banner of an unfinished benchmark; empty for a complete one.
std::string unfinishedHtml(const BenchRecord& record);

/// A benchmark as parts of a report: the answer for the headline group, then plots, images, causes of error and tables.
/// Images are omitted if `pictureBytes` is empty. Throws what reading images throws.
ReportBench benchHtml(const BenchRecord& record, const BenchGroup& headline, const PictureBytes& pictureBytes);

} // namespace tessera::validation
