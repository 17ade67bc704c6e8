#pragma once

namespace metamorph::tests {

/// Address and thread sanitizers take more memory and stack than the program, need system calls of
/// their own, and have their own handler where memory ends.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool is_sanitized = true;
#elif defined(__has_feature)
inline constexpr bool is_sanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace metamorph::tests
