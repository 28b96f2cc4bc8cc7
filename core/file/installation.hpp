#pragma once
#include <filesystem>
#include <string>
#include <system_error>

namespace nextview {

/// The file of the running program, links followed. Needs /proc.
std::filesystem::path running_program(std::error_code& error);

/// Where the libraries lie that a program loads itself: lib/nextview of the installation if the program lies in a
/// folder "bin", beside the program otherwise (a build).
std::filesystem::path libraries_of(const std::filesystem::path& program);

/// A folder of files that come with Nextview, "assets" or "shaders": in share/nextview of the running program's
/// installation, or beside it (a build), wherever that was moved; for programs of others, which have no such folder,
/// where Nextview was configured to be installed.
std::filesystem::path shared_folder(const std::string& name);

}  // namespace nextview
