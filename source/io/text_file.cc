#include <snug/base/errors.h>
#include <snug/io/text_file.h>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace snug::io {
void write_text_file(const std::string &path, const std::string &text)
{
  const std::string beside = path + ".part";
  errno                    = 0;
  {
    std::ofstream out(beside, std::ios::binary);
    out.write(text.data(), text.size());
    out.close();
    if (!out)
      throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
  }
  if (std::rename(beside.c_str(), path.c_str()) != 0)
    throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
}

std::string exact(double x)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.16e", x);
  return text;
}

std::string padded(unsigned int number, unsigned int digits)
{
  const std::string text = std::to_string(number);
  return std::string(digits - std::min<std::size_t>(digits, text.size()), '0') + text;
}

void make_output_directory(const RunContext &context, const std::string &path)
{
  everywhere(context.communicator(), [&] {
    if (context.rank() != 0)
      return;
    std::error_code error;
    std::filesystem::create_directories(path, error);
    const std::string probe = path + "/.snug-probe";
    if (!error && !(std::ofstream(probe) << "x").flush())
      error = std::error_code(errno, std::generic_category());
    std::remove(probe.c_str());
    if (error)
      throw bad_entry("Output directory", path,
                      "must be a directory this program may write in (" + error.message() + ")");
  });
}
} // namespace snug::io
