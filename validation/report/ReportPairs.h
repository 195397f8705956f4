#pragma once
#include <string>

#include "validation/report/Report.h"

namespace tessera::validation {

/// The table of all pairs, one row each. HTML.
std::string pairTableHtml(const CompareRecord& record);

/// What a range tolerance dropped, in a paragraph; empty where none is set. HTML.
std::string droppedHtml(const CompareRecord& record);

/// One pair: what it missed, its slider, its heat map and all its figures. HTML; `index` numbers the pair on the page.
std::string pairHtml(const Report& report, std::size_t index);

/// The id that a picture of the report has on the page, or an empty string when the report has none of that name.
std::string pictureId(const Report& report, const std::string& name);

} // namespace tessera::validation
