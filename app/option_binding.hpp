#pragma once
// Binds fields of options structs to the command line: their defaults live in the struct alone.

#include <array>
#include <boost/program_options.hpp>
#include <charconv>
#include <concepts>
#include <string>

namespace tcm_icp::app {

/// An option with a default, the value of `*field`, which the help shows in the shortest digits that give it back (0.4,
/// not 0.40000000000000002).
template <typename T>
boost::program_options::typed_value<T>* bind_option(T* field) {
  auto* option = boost::program_options::value(field);
  if constexpr (std::floating_point<T>) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), *field).ptr;
    return option->default_value(*field, std::string(text.data(), end));
  } else {
    return option->default_value(*field);
  }
}

}  // namespace tcm_icp::app
