#pragma once
#include <string>

namespace tessera::test {

/// What an error of this type says that the work throws; empty where it throws none.
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
