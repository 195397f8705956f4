#pragma once
#include <string>
#include <vector>

#include "validation/stress/Stress.h"

namespace tessera::validation {

/// The results of `tessera stress`.
struct StressRecord {
    std::string renderer; ///< as GL reports it
    StressEffort effort = StressEffort::Full;
    std::vector<StressResult> results;

    /// Whether there is a result and all hold.
    bool ok() const;
};

/// The record as JSON, schema 1, indented and ending in a newline. What was not measured is null, with the reason under
/// `why`.
std::string stressJson(const StressRecord& record);

/// The record for a terminal: a table of ASCII characters, one row per case and technique, then the missed tolerances.
std::string stressTable(const StressRecord& record);

/// All cases with their contracts, for a terminal.
std::string stressList();

} // namespace tessera::validation
