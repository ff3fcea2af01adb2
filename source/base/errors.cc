#include <snug/base/errors.h>

#include <deal.II/base/exceptions.h>

#include <new>
#include <sstream>

namespace snug {
std::string Place::text() const
{
  return file + (line > 0 ? ", line " + std::to_string(line) : "") + (file.empty() ? "" : ": ");
}

InputError::InputError(const WrongEntry &wrong, const Place &place)
  : InputError("entry '" + wrong.entry + "' = '" + wrong.value + "': " + wrong.allowed +
                 (wrong.suggestion.empty() ? "" : "; did you mean '" + wrong.suggestion + "'?"),
               place,
               wrong)
{}

bool is_out_of_memory(const std::exception &error)
{
  return dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
         dynamic_cast<const dealii::StandardExceptions::ExcOutOfMemory *>(&error) != nullptr;
}

std::string one_line(const std::exception &error)
{
  std::ostringstream text;
  if (is_out_of_memory(error))
    text << "out of memory: use a coarser mesh, or distribute the ranks over more machines";
  else if (const auto *banner = dynamic_cast<const dealii::ExceptionBase *>(&error))
    banner->print_info(text);
  else
    text << error.what();
  std::istringstream words(text.str());
  std::string        word, line;
  while (words >> word)
    line += (line.empty() ? "" : " ") + word;
  return line;
}
} // namespace snug
