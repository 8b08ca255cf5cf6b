// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <vector>

namespace anneal6d {

/// What colours the object and its surroundings have, learned while tracking (thesis 7.2;
/// histograms as of Prisacariu and Reid, IJCV 2012): single-coloured objects have little else
/// beside their outline. Grey images work, too, less well.
class Appearance {
 public:
  static constexpr int kLevels = 32;       ///< a channel of a colour image
  static constexpr int kGreyLevels = 128;  ///< of a grey image

  explicit Appearance(int channels);

  /// Index of a colour; `pixel` points to as many bytes as there are channels.
  std::uint16_t bin(const std::uint8_t* pixel) const {
    if (channels_ == 1) return pixel[0] >> 1;
    return static_cast<std::uint16_t>((pixel[0] >> 3) << 10 | (pixel[1] >> 3) << 5 | pixel[2] >> 3);
  }

  /// Logarithm of how much more likely a colour is on the object than beside it, in steps of
  /// 1/kScale, limited to +-kLimit of them; 0 for colours that were not seen.
  std::int8_t log_odds(std::uint16_t bin) const { return log_odds_[bin]; }
  /// Those of all bins; four bytes can be read at each.
  const std::int8_t* log_odds() const { return log_odds_.data(); }
  static constexpr int kScale = 32;
  static constexpr int kLimit = 96;

  int channels() const { return channels_; }
  bool learned() const { return learned_; }

  /// Takes the colours of one frame in, as bins, at a share that forgets old frames slowly. Nothing
  /// happens if either list is nearly empty.
  void learn(const std::vector<std::uint16_t>& object, const std::vector<std::uint16_t>& beside);

 private:
  int channels_;
  bool learned_ = false;
  std::vector<float> object_, beside_;  ///< relative frequencies
  std::vector<std::uint16_t> seen_;     ///< bins of which one of them is not 0
  std::vector<std::int8_t> log_odds_;
};

}  // namespace anneal6d
