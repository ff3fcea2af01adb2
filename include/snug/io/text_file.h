#ifndef snug_io_text_file_h
#define snug_io_text_file_h

#include <snug/base/run_context.h>

#include <fstream>
#include <string>
#include <vector>

namespace snug::io {
/**
 * A file that is written part by part, by one rank. The parts go to a file beside it, which
 * finish() renames, so that a reader finds the old or the new file, never a part of a file.
 */
class FileInParts
{
public:
  explicit FileInParts(std::string path);

  /// Append a part. Does not throw: finish() reports a failure.
  void append(const std::string &part);

  /// Close the file and give it its name.
  /// @throws std::runtime_error naming the file and the reason of the first failure.
  void finish();

private:
  void keep_error();

  std::string   path;
  std::ofstream out;
  int           error = 0; ///< as errno; 0: none
};

/// Replace the file @p path by @p text, as FileInParts does. For one rank.
/// @throws std::runtime_error naming the file and the reason.
void write_text_file(const std::string &path, const std::string &text);

/// Return @p x with 17 significant digits, from which the same number is read.
std::string exact(double x);

/// Return @p x with 9 digits, for tables that people read.
std::string rounded(double x);

/// Return @p number with leading zeros to at least @p digits digits.
std::string padded(unsigned int number, unsigned int digits);

/**
 * Make the directory @p path and its parents, if they do not exist, and try to write in it.
 * Collective. @throws InputError if that fails.
 */
void make_output_directory(const RunContext &context, const std::string &path);

/**
 * Remove results of earlier runs in @p directories: the files with the names that this program
 * gives to results, journals and warm starts, and no others. Pictures of another run would
 * otherwise remain beside those of this run. Collective.
 */
void remove_results(const RunContext &context, const std::vector<std::string> &directories);
} // namespace snug::io

#endif
