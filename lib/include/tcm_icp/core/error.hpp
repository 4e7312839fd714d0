#pragma once
// The errors the library throws. The app turns each into an exit code; a numerical outcome is a Termination instead.

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tcm_icp {

/// Base of everything the library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option outside its bounds; the message names field, value and bound.
class InvalidOptions : public Error {
 public:
  using Error::Error;
};

/// Data that cannot be registered: too few points, all in one place, a pose that is not rigid.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be read. `place` is a line or byte position ("line 12", "byte 4096", "header"), `remedy` what to
/// do.
class InputError : public Error {
 public:
  /// The message is "path: place: problem; remedy".
  InputError(const std::filesystem::path& path, const std::string& place, const std::string& problem,
             const std::string& remedy)
      : Error(path.string() + (place.empty() ? "" : ": " + place) + ": " + problem +
              (remedy.empty() ? "" : "; " + remedy)) {}
};

/// A file or folder that cannot be written.
class OutputError : public Error {
 public:
  /// The message is "path: problem; remedy".
  OutputError(const std::filesystem::path& path, const std::string& problem, const std::string& remedy)
      : Error(path.string() + ": " + problem + (remedy.empty() ? "" : "; " + remedy)) {}
};

/// The caller's on_progress asked to stop. Nothing has been written.
class Cancelled : public Error {
 public:
  Cancelled() : Error("interrupted") {}
};

}  // namespace tcm_icp
