#pragma once
#include <span>
#include <string>

#include "validation/bench/BenchRecord.h"

/// The tables of a benchmark's page, as HTML; empty if there is nothing to show.
namespace tessera::validation {

/// Each group's recommendation in a row.
std::string answersHtml(const BenchRecord& record);
/// What each cause adds to the error of a group.
std::string attributionHtml(const BenchGroup& group);
/// Every point of a group.
std::string pointsHtml(const BenchGroup& group);
/// The exponents of the scaling curves.
std::string fitsHtml(std::span<const BenchGroup> groups);

} // namespace tessera::validation
