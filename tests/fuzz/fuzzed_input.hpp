#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace nextview {

/// A file of this name with these bytes, in a folder of the process's own, which goes with it. The name may have
/// folders in front.
std::filesystem::path fuzzed_file(const std::string& name, std::string_view bytes);

/// Calls a reader. It may refuse an input as declarations say: std::runtime_error or std::invalid_argument with a
/// reason. Anything else ends the process, as a fuzzer wants it: there is not to be another exception, nor want of
/// memory, whatever the input.
/// @return whether it was read
bool is_read(const std::function<void()>& read);

/// Ends the process where something that was read is not what it has to be.
void require(bool holds, const char* what);

/// The parts of an input that stands for several files: apart by a line `%%%`. @param rest what is behind the part
std::string_view next_part(std::string_view& rest);

}  // namespace nextview

/// What each fuzzer defines. Source: libFuzzer's interface.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
