#include <snug/base/errors.h>
#include <snug/io/text_file.h>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace snug::io {
// The file beside the path is on the same file system, where rename() replaces a file in one step.
FileInParts::FileInParts(std::string the_path) : path(std::move(the_path))
{
  errno = 0;
  out.open(path + ".part", std::ios::binary);
  keep_error();
}

void FileInParts::append(const std::string &part)
{
  errno = 0;
  out.write(part.data(), static_cast<std::streamsize>(part.size()));
  keep_error();
}

void FileInParts::finish()
{
  errno = 0;
  // close() writes the last bytes to the disk, so check for errors after it.
  out.close();
  keep_error();
  if (error == 0 && std::rename((path + ".part").c_str(), path.c_str()) != 0)
    error = errno;
  if (error != 0)
    throw std::runtime_error("cannot write '" + path + "': " + std::strerror(error));
}

/// Keep the reason of the first failure. Streams need not set errno.
void FileInParts::keep_error()
{
  if (!out && error == 0)
    error = errno != 0 ? errno : EIO;
}

void write_text_file(const std::string &path, const std::string &text)
{
  FileInParts file(path);
  file.append(text);
  file.finish();
}

std::string exact(double x)
{
  char text[32];
  // One digit before the point and 16 after it give 17 digits, which distinguish all doubles.
  std::snprintf(text, sizeof(text), "%.16e", x);
  return text;
}

std::string rounded(const double x)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", x);
  return text;
}

std::string padded(unsigned int number, unsigned int digits)
{
  const std::string text = std::to_string(number);
  return std::string(digits - std::min<std::size_t>(digits, text.size()), '0') + text;
}

void make_output_directory(const RunContext &context, const std::string &path)
{
  // One rank tries, and all ranks fail if it fails.
  throw_collectively(context.communicator(), [&] {
    if (context.rank() != 0)
      return;
    std::error_code error;
    std::filesystem::create_directories(path, error);
    // Try to write, because this detects more than permissions show: a full disk, a read-only
    // mount, or the rights of root.
    const std::string probe = path + "/.snug-probe";
    // flush() writes at once. The destructor would not report an error.
    if (!error && !(std::ofstream(probe) << "x").flush())
      error = std::error_code(errno, std::generic_category());
    std::remove(probe.c_str());
    if (error)
      throw bad_entry("Output directory", path,
                      "must be a directory this program may write in (" + error.message() + ")");
  });
}

namespace {
void remove_files(const std::string &directory, const std::regex &names)
{
  std::error_code ignored; // a file that stays does no harm
  for (const auto &entry : std::filesystem::directory_iterator(directory, ignored))
    if (entry.is_regular_file(ignored) && std::regex_match(entry.path().filename().string(), names))
      std::filesystem::remove(entry.path(), ignored);
}
} // namespace

void remove_results(const RunContext &context, const std::vector<std::string> &directories)
{
  static const std::regex ours(
    "(solution|contact)(\\.pvd|-\\d{4,}\\.(vtm|pvtu))|"
    "(contact|ties)-\\d{4,}\\.csv|(history|gradients|load_cases)\\.csv|summary\\.json|"
    "surface\\.stl|profile\\.step|bodies\\.(msh|inp)|(profile|control-points)\\.csv|"
    "journal\\.txt|warm-start\\.(\\d+\\.)?[01]");
  static const std::regex of_qp("(K|B|R|f|g|bounded|u|lambda)\\.(petsc|mtx)");
  static const std::regex states("(solution|contact)-\\d{4,}"),
    blocks("\\d{2,}-.*\\.\\d{4,}\\.vtu");
  throw_collectively(context.communicator(), [&] {
    if (context.rank() != 0)
      return;
    for (const auto &directory : directories)
      {
        remove_files(directory, ours);
        std::error_code ignored;
        for (const auto &entry : std::filesystem::directory_iterator(directory, ignored))
          if (entry.is_directory(ignored) &&
              std::regex_match(entry.path().filename().string(), states))
            {
              remove_files(entry.path().string(), blocks);
              std::filesystem::remove(entry.path(), ignored); // if it is empty
            }
        remove_files(directory + "/qp", of_qp);
      }
  });
}
} // namespace snug::io
