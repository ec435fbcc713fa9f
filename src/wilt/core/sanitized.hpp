// Whether a sanitizer watches the program: WILT_SANITIZED is 1 then, else 0. Such a program reserves
// addresses beyond any limit and answers crashes itself.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // g++
#define WILT_SANITIZED 1
#elif defined(__has_feature)  // clang++
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define WILT_SANITIZED 1
#endif
#endif
#ifndef WILT_SANITIZED
#define WILT_SANITIZED 0
#endif
