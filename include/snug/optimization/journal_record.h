#ifndef snug_optimization_journal_record_h
#define snug_optimization_journal_record_h

#include <snug/optimization/design_problem.h>

#include <string>
#include <vector>

namespace snug::optimization {
/// This struct holds one evaluation as the journal keeps it.
struct JournalRecord
{
  enum class Outcome
  {
    value,
    tangled, ///< TangledMesh
    unsolved ///< any other SolveError
  };

  std::vector<double> x;
  Outcome             outcome = Outcome::value;
  Evaluation          evaluation; ///< if outcome is value
  std::string         message;    ///< one line, otherwise
  int                 n_ranks = 1;
  std::size_t         end     = 0; ///< byte behind it in the journal
};

/**
 * Return the text of record @p index. Numbers are in hexadecimal floating point (%a),
 * so that they are read back bit for bit. The line "end <index>" closes the record.
 */
std::string journal_text(const JournalRecord &record, unsigned int index);

/// Return the first lines of a journal: format version and fingerprint.
std::string journal_header(const std::string &fingerprint);

/// This struct holds the content of a journal.
struct JournalContents
{
  std::size_t                header_end = 0; ///< bytes; 0: no whole header
  std::vector<JournalRecord> records;        ///< the complete ones
};

/**
 * Return the content of the text of a journal. An incomplete header or last record is left out.
 * @throws InputError naming @p file if it is not a journal of this format
 *   and @p fingerprint (with the line that differs), or is damaged before
 *   its last record.
 */
JournalContents
parse_journal(const std::string &text, const std::string &fingerprint, const std::string &file);
} // namespace snug::optimization

#endif
