#include <snug/base/errors.h>
#include <snug/optimization/journal_record.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace snug::optimization {
namespace {
const std::string format_line = "snug journal 1";

std::string numbers_line(const std::string &name, const std::vector<double> &numbers)
{
  std::string line = name;
  char        text[32];
  for (const double number : numbers)
    {
      std::snprintf(text, sizeof(text), " %a", number);
      line += text;
    }
  return line + '\n';
}

std::string single_line(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<std::string> split_lines(const std::string &text)
{
  std::vector<std::string> lines;
  std::istringstream       in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

/// This class reads the whole lines of a text one after the other.
class LineReader
{
public:
  explicit LineReader(const std::string &the_text) : text(the_text) {}

  bool get(std::string &line)
  {
    const auto stop = text.find('\n', position);
    if (stop == std::string::npos)
      return false;
    line     = text.substr(position, stop - position);
    position = stop + 1;
    return true;
  }

  const std::string &text;
  std::size_t        position = 0;
};

bool parse_numbers(const std::string &text, std::vector<double> &numbers)
{
  const char *next = text.c_str();
  while (*next != '\0')
    {
      char *after = nullptr;
      numbers.push_back(std::strtod(next, &after));
      if (after == next)
        return false;
      next = after;
    }
  return true;
}

/// Add a line to a record. Return false if the line cannot belong to a record.
bool parse_line(const std::string &line, JournalRecord &record)
{
  const auto        space = std::min(line.find(' '), line.size());
  const std::string name  = line.substr(0, space);
  const std::string rest  = line.substr(std::min(space + 1, line.size()));
  auto             &value = record.evaluation;
  if (name == "tangled" || name == "unsolved")
    {
      record.outcome =
        name == "tangled" ? JournalRecord::Outcome::tangled : JournalRecord::Outcome::unsolved;
      record.message = rest;
      return true;
    }
  std::vector<double> numbers;
  if (!parse_numbers(rest, numbers))
    return false;
  if (name == "x")
    record.x = numbers;
  else if (name == "objective" && numbers.size() == 1)
    value.objective = numbers[0];
  else if (name == "gradient")
    value.gradient = numbers;
  else if (name == "constraints")
    value.constraints = numbers;
  else if (name == "jacobian")
    value.jacobian.push_back(numbers);
  else if (name == "reported")
    value.reported = numbers;
  else if (name == "linearization")
    value.linearization = numbers;
  else if (name == "notes" && numbers.size() == 4)
    {
      value.active_contacts       = static_cast<unsigned int>(numbers[0]);
      value.f_mults               = static_cast<unsigned long>(numbers[1]);
      value.seconds               = numbers[2];
      value.least_scaled_jacobian = numbers[3];
    }
  else
    return false;
  return true;
}

enum class Reading
{
  complete,
  torn,
  damaged
};

Reading parse_record(LineReader &reader, unsigned int index, JournalRecord &record)
{
  std::string line;
  if (!reader.get(line))
    return Reading::torn;
  const std::string start = "record " + std::to_string(index) + " on ";
  if (line.compare(0, start.size(), start) != 0)
    return Reading::damaged;
  record.n_ranks         = std::atoi(line.c_str() + start.size());
  const std::string last = "end " + std::to_string(index);
  while (reader.get(line))
    {
      if (line == last)
        {
          record.end = reader.position;
          return Reading::complete;
        }
      if (!parse_line(line, record))
        return Reading::damaged;
    }
  return Reading::torn;
}

/// Return the end of the header [bytes], or 0 if the header is incomplete. @throws InputError if
/// the journal has another format or fingerprint.
std::size_t
parse_header(LineReader &reader, const std::string &fingerprint, const std::string &file)
{
  const std::string expected  = journal_header(fingerprint);
  const std::string beginning = reader.text.substr(0, format_line.size() + 1);
  if ((format_line + '\n').compare(0, beginning.size(), beginning) != 0)
    throw InputError(file + " begins with '" + split_lines(beginning).front() +
                     "': a journal this program can replay begins with "
                     "'" +
                     format_line + "'");
  const std::string closing = "\nfingerprint end\n";
  const auto        stop    = reader.text.find(closing);
  if (stop == std::string::npos)
    return 0;
  reader.position   = stop + closing.size();
  const auto found  = split_lines(reader.text.substr(0, reader.position));
  const auto wanted = split_lines(expected);
  for (unsigned int i = 0; i < std::max(found.size(), wanted.size()); ++i)
    {
      const std::string there = i < found.size() ? found[i] : "nothing";
      const std::string here  = i < wanted.size() ? wanted[i] : "nothing";
      if (there != here)
        throw InputError(file +
                         " was written for another problem: it "
                         "has '" +
                         there + "', this run '" + here +
                         "'; start without --restart or restore the "
                         "input");
    }
  return reader.position;
}
} // namespace

std::string journal_text(const JournalRecord &record, const unsigned int index)
{
  const auto       &value  = record.evaluation;
  const std::string number = std::to_string(index);
  std::string text = "record " + number + " on " + std::to_string(record.n_ranks) + " ranks\n" +
                     numbers_line("x", record.x);
  switch (record.outcome)
    {
      case JournalRecord::Outcome::value:
        text += numbers_line("objective", {value.objective}) +
                numbers_line("gradient", value.gradient) +
                numbers_line("constraints", value.constraints);
        for (const auto &row : value.jacobian)
          text += numbers_line("jacobian", row);
        if (!value.reported.empty())
          text += numbers_line("reported", value.reported);
        if (!value.linearization.empty())
          text += numbers_line("linearization", value.linearization);
        text += numbers_line("notes", {double(value.active_contacts), double(value.f_mults),
                                       value.seconds, value.least_scaled_jacobian});
        break;
      case JournalRecord::Outcome::tangled:
        text += "tangled " + single_line(record.message) + '\n';
        break;
      case JournalRecord::Outcome::unsolved:
        text += "unsolved " + single_line(record.message) + '\n';
    }
  return text + "end " + number + '\n';
}

std::string journal_header(const std::string &fingerprint)
{
  std::string text = format_line + '\n';
  for (const auto &line : split_lines(fingerprint))
    text += "fingerprint: " + line + '\n';
  return text + "fingerprint end\n";
}

JournalContents
parse_journal(const std::string &text, const std::string &fingerprint, const std::string &file)
{
  JournalContents contents;
  LineReader      reader(text);
  if (text.empty())
    return contents;
  contents.header_end = parse_header(reader, fingerprint, file);
  if (contents.header_end == 0)
    return contents;
  for (unsigned int index = 0; reader.position < text.size(); ++index)
    {
      JournalRecord record;
      const Reading reading = parse_record(reader, index, record);
      const bool    is_last = text.find("\nend ", reader.position) == std::string::npos;
      if (reading == Reading::damaged && !is_last)
        throw InputError(file + ": record " + std::to_string(index) + " is damaged");
      if (reading != Reading::complete)
        break;
      contents.records.push_back(record);
    }
  return contents;
}
} // namespace snug::optimization
