// What someone meant who wrote a word that is not known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porosph {

/// The word of `known` that was probably meant, or "" if none is near (edit distance).
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace porosph
