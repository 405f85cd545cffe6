/* Stands between a process and the C library (LD_PRELOAD): counts calls on files below one folder, and lets one fail.

   fault_counters   memory that copies of the process share: calls by kind, then whether the fault came
   fault_arm        which call below which folder fails, and how; until then nothing is counted
*/
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum { WRITE, SYNC, RENAME, OPEN, MKDIR, UNLINK, KINDS };

static long *counters;
static char folder[PATH_MAX];
static size_t length;
static int armed = 0, fault_kind = -1, fault_error, fault_stays, fault_signal;
static long fault_number;

long *fault_counters(void) {
  if (!counters)
    counters = mmap(NULL, sizeof(long) * (KINDS + 1), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return counters;
}

/* error 0: a signal comes before the call, which is done then; stays: every later call of the kind fails as well */
void fault_arm(const char *below, int kind, long number, int error, int stays, int signal_number) {
  strncpy(folder, below, sizeof folder - 1);
  length = strlen(folder);
  fault_kind = kind;
  fault_number = number;
  fault_error = error;
  fault_stays = stays;
  fault_signal = signal_number;
  memset(fault_counters(), 0, sizeof(long) * (KINDS + 1));
  armed = 1;
}

static int fails(int kind, const char *path) {
  if (!armed || !path || strncmp(path, folder, length) != 0) return 0;
  long number = ++counters[kind];
  if (kind != fault_kind || !(number == fault_number || (fault_stays && number > fault_number))) return 0;
  counters[KINDS] = 1;
  if (fault_signal) kill(getpid(), fault_signal);
  if (fault_error) errno = fault_error;
  return fault_error != 0;
}

static int fails_of(int kind, int descriptor) {
  char link[64], path[PATH_MAX];
  if (!armed) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  ssize_t size = readlink(link, path, sizeof path - 1);
  if (size < 0) return 0;
  path[size] = 0;
  return fails(kind, path);
}

#define NEXT(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

ssize_t write(int f, const void *b, size_t n) {
  return fails_of(WRITE, f) ? -1 : NEXT(ssize_t, "write", int, const void *, size_t)(f, b, n);
}
ssize_t pwrite(int f, const void *b, size_t n, off_t o) {
  return fails_of(WRITE, f) ? -1 : NEXT(ssize_t, "pwrite", int, const void *, size_t, off_t)(f, b, n, o);
}
ssize_t pwrite64(int f, const void *b, size_t n, off64_t o) {
  return fails_of(WRITE, f) ? -1 : NEXT(ssize_t, "pwrite64", int, const void *, size_t, off64_t)(f, b, n, o);
}
ssize_t writev(int f, const struct iovec *v, int n) {
  return fails_of(WRITE, f) ? -1 : NEXT(ssize_t, "writev", int, const struct iovec *, int)(f, v, n);
}
size_t fwrite(const void *b, size_t s, size_t n, FILE *f) {
  return f && fails_of(WRITE, fileno(f)) ? 0 : NEXT(size_t, "fwrite", const void *, size_t, size_t, FILE *)(b, s, n, f);
}
int fsync(int f) { return fails_of(SYNC, f) ? -1 : NEXT(int, "fsync", int)(f); }
int fdatasync(int f) { return fails_of(SYNC, f) ? -1 : NEXT(int, "fdatasync", int)(f); }
int rename(const char *a, const char *b) {
  return fails(RENAME, b) ? -1 : NEXT(int, "rename", const char *, const char *)(a, b);
}
int renameat(int d, const char *a, int e, const char *b) {
  return fails(RENAME, b) ? -1 : NEXT(int, "renameat", int, const char *, int, const char *)(d, a, e, b);
}
int mkdir(const char *p, mode_t m) { return fails(MKDIR, p) ? -1 : NEXT(int, "mkdir", const char *, mode_t)(p, m); }
int mkdirat(int d, const char *p, mode_t m) {
  return fails(MKDIR, p) ? -1 : NEXT(int, "mkdirat", int, const char *, mode_t)(d, p, m);
}
int unlink(const char *p) { return fails(UNLINK, p) ? -1 : NEXT(int, "unlink", const char *)(p); }
int rmdir(const char *p) { return fails(UNLINK, p) ? -1 : NEXT(int, "rmdir", const char *)(p); }
FILE *fopen(const char *p, const char *m) {
  return fails(OPEN, p) ? NULL : NEXT(FILE *, "fopen", const char *, const char *)(p, m);
}
FILE *fopen64(const char *p, const char *m) {
  return fails(OPEN, p) ? NULL : NEXT(FILE *, "fopen64", const char *, const char *)(p, m);
}

#define MODE(flags)                       \
  mode_t mode = 0;                        \
  if ((flags) & (O_CREAT | O_TMPFILE)) {  \
    va_list more;                         \
    va_start(more, flags);                \
    mode = va_arg(more, mode_t);          \
    va_end(more);                         \
  }

int open(const char *p, int flags, ...) {
  MODE(flags)
  return fails(OPEN, p) ? -1 : NEXT(int, "open", const char *, int, mode_t)(p, flags, mode);
}
int open64(const char *p, int flags, ...) {
  MODE(flags)
  return fails(OPEN, p) ? -1 : NEXT(int, "open64", const char *, int, mode_t)(p, flags, mode);
}
int openat(int d, const char *p, int flags, ...) {
  MODE(flags)
  return fails(OPEN, p) ? -1 : NEXT(int, "openat", int, const char *, int, mode_t)(d, p, flags, mode);
}
int openat64(int d, const char *p, int flags, ...) {
  MODE(flags)
  return fails(OPEN, p) ? -1 : NEXT(int, "openat64", int, const char *, int, mode_t)(d, p, flags, mode);
}
