#ifndef snug_io_text_file_h
#define snug_io_text_file_h

#include <snug/base/run_context.h>

#include <string>
#include <vector>

namespace snug::io {
/**
 * Replace the file @p path by @p text. It is written beside it and renamed,
 * so that a reader finds the old or the new file, never half of one.
 * @throws std::runtime_error naming the file and the reason.
 */
void write_text_file(const std::string &path, const std::string &text);

/// @p x with 17 significant digits, which read back as the same number.
std::string exact(double x);

/// @p number with leading zeros to at least @p digits digits.
std::string padded(unsigned int number, unsigned int digits);

/**
 * Make the directory @p path and its parents, if need be, and try to write
 * in it. Collective. @throws InputError if that fails.
 */
void make_output_directory(const RunContext &context, const std::string &path);

/**
 * Remove what earlier runs left in @p directories: the files of the names
 * this program gives to results, journals and warm starts, and no others.
 * Pictures of another run would stand beside this one's. Collective.
 */
void remove_results(const RunContext &context, const std::vector<std::string> &directories);
} // namespace snug::io

#endif
