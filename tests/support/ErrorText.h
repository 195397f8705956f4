#pragma once
#include <string>

namespace tessera::test {

/// The message of the `Error` that `work` throws; empty if it throws none.
template <typename Error, typename Work>
std::string errorText(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace tessera::test
