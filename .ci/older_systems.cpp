// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the C and C++ libraries of the machine that builds have, and those of older ones lack, so
// that the wheel runs there too (glibc 2.28, libstdc++ of GCC 8). package.py makes a library of it,
// and has our modules, Embree and TBB ask for these names instead.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <time.h>

#include <cstdint>
#include <exception>

// --- Old functions that have moved to another library, or got a new version ------------------------

// `name` under our prefix: a jump to the function that has been there since version `since`.
#define JANUS_OLD(name, since)                                \
  __asm__(".symver old_" #name ", " #name "@" since           \
          "\n.globl janus_" #name "\n.type janus_" #name      \
          ", @function\njanus_" #name ":\n  jmp *old_" #name  \
          "@GOTPCREL(%rip)\n.size janus_" #name ", . - janus_" #name "\n")

JANUS_OLD(__pthread_key_create, "GLIBC_2.2.5");
JANUS_OLD(pthread_attr_getstack, "GLIBC_2.2.5");
JANUS_OLD(pthread_attr_setstacksize, "GLIBC_2.2.5");
JANUS_OLD(pthread_cancel, "GLIBC_2.2.5");
JANUS_OLD(pthread_create, "GLIBC_2.2.5");
JANUS_OLD(pthread_detach, "GLIBC_2.2.5");
JANUS_OLD(pthread_getaffinity_np, "GLIBC_2.3.4");
JANUS_OLD(pthread_getattr_np, "GLIBC_2.2.5");
JANUS_OLD(pthread_getspecific, "GLIBC_2.2.5");
JANUS_OLD(pthread_join, "GLIBC_2.2.5");
JANUS_OLD(pthread_key_create, "GLIBC_2.2.5");
JANUS_OLD(pthread_key_delete, "GLIBC_2.2.5");
JANUS_OLD(pthread_mutex_trylock, "GLIBC_2.2.5");
JANUS_OLD(pthread_mutexattr_destroy, "GLIBC_2.2.5");
JANUS_OLD(pthread_mutexattr_init, "GLIBC_2.2.5");
JANUS_OLD(pthread_mutexattr_settype, "GLIBC_2.2.5");
JANUS_OLD(pthread_once, "GLIBC_2.2.5");
JANUS_OLD(pthread_setaffinity_np, "GLIBC_2.3.4");
JANUS_OLD(pthread_setspecific, "GLIBC_2.2.5");
JANUS_OLD(dladdr, "GLIBC_2.2.5");
JANUS_OLD(dlclose, "GLIBC_2.2.5");
JANUS_OLD(dlerror, "GLIBC_2.2.5");
JANUS_OLD(dlopen, "GLIBC_2.2.5");
JANUS_OLD(dlsym, "GLIBC_2.2.5");
JANUS_OLD(exp, "GLIBC_2.2.5");
JANUS_OLD(log, "GLIBC_2.2.5");
JANUS_OLD(pow, "GLIBC_2.2.5");
JANUS_OLD(hypot, "GLIBC_2.2.5");
JANUS_OLD(hypotf, "GLIBC_2.2.5");

__asm__(".symver old___fxstat64, __fxstat64@GLIBC_2.2.5");

// --- New functions --------------------------------------------------------------------------------

extern "C" {

// "May be more than one": counters are then changed by atomic operations, always.
char janus___libc_single_threaded = 0;

// A macro around the old function before glibc 2.33.
int old___fxstat64(int version, int file, struct stat64* status);
int janus_fstat64(int file, struct stat64* status) { return old___fxstat64(1, file, status); }

std::uint32_t janus_arc4random() {
  std::uint32_t number = 0;
  while (getrandom(&number, sizeof(number), 0) != static_cast<ssize_t>(sizeof(number))) {
  }
  return number;
}

// A wait up to a time of another clock than that of the day, which the old function knows alone.
int janus_pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                                 const struct timespec* until) {
  constexpr long long kSecond = 1000000000;
  const auto read = [](clockid_t of) {
    timespec t{};
    clock_gettime(of, &t);
    return t.tv_sec * kSecond + t.tv_nsec;
  };
  const long long left = until->tv_sec * kSecond + until->tv_nsec - read(clock);
  const long long then = read(CLOCK_REALTIME) + (left > 0 ? left : 0);
  const timespec at{static_cast<time_t>(then / kSecond), static_cast<long>(then % kSecond)};
  return pthread_cond_timedwait(condition, mutex, &at);
}

// std::__throw_bad_array_new_length()
[[noreturn]] void __cxa_throw_bad_array_new_length();
[[noreturn]] void janus__ZSt28__throw_bad_array_new_lengthv() { __cxa_throw_bad_array_new_length(); }

// std::exception_ptr counts in functions that were private; its copy constructor and destructor do
// the same.
void copy_exception(void* to, const void* from) __asm__(
    "_ZNSt15__exception_ptr13exception_ptrC1ERKS0_");
void drop_exception(void* self) __asm__("_ZNSt15__exception_ptr13exception_ptrD1Ev");
void janus__ZNSt15__exception_ptr13exception_ptr9_M_addrefEv(void* self) {
  void* copy = nullptr;  // never destroyed
  copy_exception(&copy, self);
}
void janus__ZNSt15__exception_ptr13exception_ptr10_M_releaseEv(void* self) {
  drop_exception(self);
  *static_cast<void**>(self) = nullptr;
}

}  // extern "C"
