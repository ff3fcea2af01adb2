#include <snug/app/failure.h>
#include <snug/app/interrupt.h>
#include <snug/app/serve.h>
#include <snug/app/served_model.h>
#include <snug/base/errors.h>
#include <snug/base/version.h>
#include <snug/feti/sparse_factor.h>
#include <snug/scene/json_scene.h>

#include <malloc.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

namespace snug::app {
namespace {
/// Maximum number of bytes of a request.
constexpr std::size_t longest_line = 16u << 20;

/// This class passes the lines of standard input to all ranks, and writes answers. All members are
/// collective.
class Connection
{
public:
  Connection(const RunContext &context, const int answers) : context(context), answers(answers) {}

  /// Store the next line, of which at most longest_line + 1 bytes are kept. Return false if there
  /// is none: at the end of the input, if nobody reads the answers, or after a signal.
  bool next(std::string &line)
  {
    long n = -1;
    if (context.rank() == 0 && read(line))
      n = static_cast<long>(line.size());
    // Broadcasts that wait would use a processor while there are no requests.
    MPI_Request request;
    int         done = 0;
    MPI_Ibcast(&n, 1, MPI_LONG, 0, context.communicator(), &request);
    while (MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (n < 0)
      return false;
    line.resize(n);
    MPI_Bcast(&line[0], static_cast<int>(n), MPI_CHAR, 0, context.communicator());
    return true;
  }

  void write(const Json &answer)
  {
    if (context.rank() == 0 && !is_closed)
      is_closed = !io::write_line(answers, answer);
  }

private:
  bool read(std::string &line)
  {
    line.clear();
    while (!is_closed)
      {
        const auto end = buffer.find('\n');
        line.append(buffer, 0, std::min(end, longest_line + 1 - line.size()));
        buffer.erase(0, end == std::string::npos ? end : end + 1);
        if (end != std::string::npos)
          return true;
        // Requests that are in the pipe at a signal are answered by errors.
        const bool is_last = is_interrupted();
        pollfd     input   = {STDIN_FILENO, POLLIN, 0};
        const int  ready   = poll(&input, 1, is_last ? 0 : 200);
        if (ready <= 0 && is_last)
          return false;
        char       bytes[1 << 16];
        const auto n = ready > 0 ? ::read(STDIN_FILENO, bytes, sizeof(bytes)) : -1;
        if (n > 0)
          buffer.assign(bytes, n);
        else if (n == 0 || (ready > 0 && errno != EINTR && errno != EAGAIN))
          return !line.empty(); // a last line without an end
      }
    return false;
  }

  const RunContext &context;
  const int         answers;
  std::string       buffer; ///< bytes behind the last line
  bool              is_closed = false;
};

/// This struct returns freed memory to the system at its end, such as that of a second model.
struct FreedMemory
{
  ~FreedMemory() { malloc_trim(0); }
};

/// Throw a io::RequestError for keys that the request does not have.
void check_keys(const Json &request, const std::string &name)
{
  static const std::map<std::string, std::vector<std::string>> keys = {
    {"describe", {}},
    {"evaluate", {"x", "gradients", "start", "contact", "errors", "outside"}},
    {"set", {"entries"}},
    {"pair", {"x", "outside"}},
    {"write", {"x", "outside"}},
    {"quit", {}}};
  const auto known = keys.find(name);
  if (known == keys.end())
    throw io::RequestError("'do' must be describe, evaluate, set, pair, write or quit, not '" +
                           name + "'");
  for (const auto &[key, value] : request.items())
    if (key != "id" && key != "do" &&
        std::find(known->second.begin(), known->second.end(), key) == known->second.end())
      throw io::RequestError("'" + name + "' has no key '" + key + "'");
}

template <int dim>
class Server
{
public:
  Server(RunContext               &context,
         const scene::SceneSource &source,
         const scene::Scene       &scene,
         const int                 answers,
         MPI_Comm                  own)
    : context(context)
    , source(source)
    , connection(context, answers)
    , own_communicator(own)
    , model(std::make_unique<ServedModel<dim>>(context, scene))
  {}

  void run()
  {
    std::signal(SIGPIPE, SIG_IGN);
    catch_interrupts();
    connection.write({{"protocol", "snug-1"},
                      {"version", SNUG_VERSION},
                      {"ready", true},
                      {"ranks", context.n_ranks()}});
    std::string line;
    while (!is_ended && connection.next(line))
      connection.write(respond(line));
    if (is_interrupted())
      context.out(Verbosity::quiet) << "ended by a signal" << std::endl;
  }

private:
  /// Return the answer to a request. Ranks whose requests end differently would wait for each
  /// other.
  Json respond(const std::string &line)
  {
    Json answer = {{"id", nullptr}};
    try
      {
        if (line.size() > longest_line)
          throw io::RequestError("a request must have at most 16 MB");
        const Json request = Json::parse(line);
        if (!request.is_object())
          throw io::RequestError("a request must be a JSON object");
        answer["id"] = request.value("id", Json());
        check_interrupts(context.communicator());
        answer.update(answer_to(request));
        fail_together(own_communicator, nullptr);
      }
    catch (const std::exception &error)
      {
        fail_together(own_communicator, &error);
        answer["error"] = io::error_part(error);
      }
    return answer;
  }

  Json answer_to(const Json &request)
  {
    if (!request.contains("do") || !request["do"].is_string())
      throw io::RequestError("'do' must be the name of a request");
    const auto name = request["do"].get<std::string>();
    check_keys(request, name);
    if (name == "describe")
      return model->describe();
    if (name == "evaluate")
      return model->evaluate(request);
    if (name == "set")
      return set(request);
    if (name == "pair")
      return model->pair(request);
    if (name == "write")
      return model->write(request);
    is_ended = true;
    return Json::object();
  }

  Json set(const Json &request)
  {
    if (!request.contains("entries") || !request["entries"].is_object())
      throw io::RequestError("'entries' must be an object of entries and values");
    const FreedMemory freed;
    auto              next = source;
    for (const auto &[entry, value] : request["entries"].items())
      {
        const std::string prefix = entry + "=";
        auto             &sets   = next.sets;
        sets.erase(std::remove_if(sets.begin(), sets.end(),
                                  [&](const auto &set) { return set.rfind(prefix, 0) == 0; }),
                   sets.end());
        const auto found = scene::entry_value(value);
        if (!found)
          throw io::RequestError("'entries': the value of '" + entry +
                                 "' must be a text, a number, true, false, or a list of numbers or "
                                 "of texts");
        sets.push_back(prefix + found->first);
      }
    const auto scene = scene::read_scene(next);
    feti::check_factor_options(scene.feti.factorization);
    if (scene.dimension != dim)
      throw io::RequestError("'Dimension' must stay " + std::to_string(dim));
    auto made = std::make_unique<ServedModel<dim>>(context, scene, model.get());
    model     = std::move(made);
    source    = std::move(next);
    return {{"rebuilt", Json::array({model->keeps_mesh() ? "problem" : "mesh"})}};
  }

  RunContext                       &context;
  scene::SceneSource                source;
  Connection                        connection;
  MPI_Comm                          own_communicator; ///< of fail_together()
  std::unique_ptr<ServedModel<dim>> model;
  bool                              is_ended = false;
};
} // namespace

int divert_standard_output()
{
  const int former = dup(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return former;
}

void serve(RunContext               &context,
           const scene::SceneSource &source,
           const scene::Scene       &scene,
           const int                 answers)
{
  MPI_Comm own;
  MPI_Comm_dup(context.communicator(), &own);
  if (scene.dimension == 2)
    Server<2>(context, source, scene, answers, own).run();
  else
    Server<3>(context, source, scene, answers, own).run();
  MPI_Comm_free(&own);
}
} // namespace snug::app
