#pragma once
#include <string>

#include "validation/bench/BenchRecord.h"
#include "validation/report/Report.h"

namespace tessera::validation {

/// The page of a benchmark. `folder` is where its pictures are kept (BenchStore.h). Throws InputError when a picture is
/// missing there.
Report benchReport(const BenchRecord& record, const std::string& folder);

/// The group at the head of the page: the first scene's group with the most work.
const BenchGroup* headlineGroup(const BenchRecord& record);

} // namespace tessera::validation
