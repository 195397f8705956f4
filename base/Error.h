#pragma once
#include <stdexcept>
#include <string>

namespace tessera {

/// Unusable user input: a missing or broken file, an unknown name, a value out of range. The text names the file, the
/// position in it and the remedy; programs print it as one line and exit with code 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace tessera
