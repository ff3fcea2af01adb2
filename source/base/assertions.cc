#include <snug/base/assertions.h>

#include <string>

namespace snug {
void throw_internal_error(const char *file,
                          const int   line,
                          const char *condition,
                          const char *reason)
{
  throw InternalError(std::string("internal error at ") + file + ":" + std::to_string(line) + ": " +
                      reason + " (violated: " + condition + ")");
}

void throw_internal_error(const char              *file,
                          const int                line,
                          const char              *condition,
                          const unsigned long long left,
                          const unsigned long long right)
{
  const std::string values = std::to_string(left) + " and " + std::to_string(right);
  throw_internal_error(file, line, condition, ("the values are " + values).c_str());
}
} // namespace snug
