#pragma once
#include <functional>
#include <string>
#include <vector>

#include "validation/bench/BenchRecord.h"
#include "validation/report/Report.h"

namespace tessera::validation {

/// The bytes of a kept picture, by the name of its file.
using PictureBytes = std::function<std::vector<std::uint8_t>(const std::string& file)>;

/// The banner of an unfinished benchmark; empty for a complete one.
std::string unfinishedHtml(const BenchRecord& record);

/// A benchmark as parts of a report: the answer for the headline group, then plots, pictures, causes of error and
/// tables. Pictures are left out where `pictureBytes` is empty. Throws what reading pictures throws.
ReportBench benchHtml(const BenchRecord& record, const BenchGroup& headline, const PictureBytes& pictureBytes);

} // namespace tessera::validation
