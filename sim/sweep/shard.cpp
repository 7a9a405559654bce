#include "sim/sweep/shard.hpp"

#include <array>
#include <charconv>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

std::optional<int> whole_number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

bool valid(Shard shard) {
  return shard.count >= 1 && shard.count <= Shard::most && shard.index >= 1 && shard.index <= shard.count;
}

Shard shard_of_rank(const Environment& environment) {
  constexpr std::array<std::pair<const char*, const char*>, 3> launchers{
      {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
       {"PMI_RANK", "PMI_SIZE"},
       {"SLURM_PROCID", "SLURM_NTASKS"}}};
  for (const auto& [rank_name, size_name] : launchers) {
    const std::optional<std::string> rank = environment(rank_name);
    const std::optional<std::string> size = environment(size_name);
    if (!rank || !size) continue;
    const Shard shard{whole_number(*rank).value_or(-1) + 1, whole_number(*size).value_or(0)};
    if (!valid(shard))
      throw std::runtime_error(fmt::format("--shard mpi: {}={} and {}={} are not a rank and a size",
                                           rank_name, *rank, size_name, *size));
    return shard;
  }
  throw std::runtime_error("--shard mpi: no rank in the environment; start it with mpirun, mpiexec or srun");
}

/// Reads what about_shard() wrote.
struct ShardNote {
  std::string about;
  Shard shard;
  std::size_t rows;
};

std::optional<ShardNote> parse_note(const std::string& text) {
  static const std::regex pattern("(.*); shard ([0-9]{1,6})/([0-9]{1,6}) of ([0-9]{1,9}) rows");
  std::smatch match;
  if (!std::regex_match(text, match, pattern)) return std::nullopt;
  return ShardNote{match[1], {std::stoi(match[2]), std::stoi(match[3])}, std::stoul(match[4])};
}

/// The number of shards in which the files beside `file` divide it. Throws when there are none, or files of
/// different divisions.
int shards_beside(const fs::path& file) {
  std::set<int> counts;
  const std::string name = file.filename().string() + ".";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::absolute(file).parent_path(), error)) {
    static const std::regex ending("[0-9]{1,6}-of-([0-9]{1,6})");
    const std::string found = entry.path().filename().string();
    if (!found.starts_with(name)) continue;
    const std::string rest = found.substr(name.size());
    std::smatch match;
    if (std::regex_match(rest, match, ending)) counts.insert(std::stoi(match[1]));
  }
  if (counts.empty())
    throw std::runtime_error(
        fmt::format("{}: no shards beside it; run hitpipe sweep --shard I/N first", file.string()));
  if (counts.size() > 1)
    throw std::runtime_error(fmt::format("{}: shards of {} and of {} beside it; remove those of another run",
                                         file.string(), *counts.begin(), *counts.rbegin()));
  return *counts.begin();
}

}  // namespace

std::optional<std::string> process_environment(const char* name) {
  const char* const value = std::getenv(name);
  if (value == nullptr) return std::nullopt;
  return value;
}

Shard parse_shard(const std::string& text, const Environment& environment) {
  if (text == "mpi") return shard_of_rank(environment);
  const std::size_t slash = text.find('/');
  const Shard shard{whole_number(text.substr(0, slash)).value_or(0),
                    slash == std::string::npos ? 0 : whole_number(text.substr(slash + 1)).value_or(0)};
  if (!valid(shard))
    throw std::runtime_error(
        fmt::format("--shard {}: allowed is I/N with I in 1..N and N in 1..{}, or mpi", text, Shard::most));
  return shard;
}

std::vector<SweepPoint> part_of(const std::vector<SweepPoint>& points, Shard shard) {
  std::vector<SweepPoint> part;
  int unit = -1;
  const SweepPoint* before = nullptr;
  for (const SweepPoint& point : points) {
    const bool same = before != nullptr && before->design == point.design && before->format == point.format;
    if (!same) ++unit;
    before = &point;
    if (unit % shard.count == shard.index - 1) part.push_back(point);
  }
  return part;
}

fs::path shard_file(const fs::path& file, Shard shard) {
  return file.string() + fmt::format(".{}-of-{}", shard.index, shard.count);
}

std::string about_shard(const std::string& about, Shard shard, std::size_t rows) {
  return fmt::format("{}; shard {}/{} of {} rows", about, shard.index, shard.count, rows);
}

RowsFile join_shards(const fs::path& file) {
  RowsFile all;
  std::map<RowKey, SweepRow> rows;
  for (Shard shard{1, shards_beside(file)}; shard.index <= shard.count; ++shard.index) {
    const fs::path part_file = shard_file(file, shard);
    const auto fail = [&](const std::string& why) {
      throw std::runtime_error(fmt::format("{}: {}", part_file.string(), why));
    };
    if (!fs::exists(part_file)) fail("is missing; run this shard first");
    const RowsFile part = read_rows(part_file);
    const std::optional<ShardNote> note = parse_note(part.about);
    if (!note || note->shard != shard) fail("line 1 does not say that it is this shard");
    if (note->rows != part.rows.size())
      fail(
          fmt::format("has {} of {} rows; run this shard again, it continues", part.rows.size(), note->rows));
    if (shard.index == 1) all.about = note->about;
    if (note->about != all.about) fail("was made of another scene or by other options than shard 1");
    for (const SweepRow& row : part.rows) {
      if (!rows.empty() && row.triangle != rows.begin()->second.triangle)
        fail(
            "counts triangle tests at another cost than the shards before; run it again with the same "
            "options");
      if (!rows.emplace(key_of(row.design, row.bits, row.rays_in_flight), row).second)
        fail(fmt::format("{} {} is in another shard too; the shards were cut differently", row.design,
                         row.bits));
    }
  }
  for (const auto& [key, row] : rows) all.rows.push_back(row);
  return all;
}

}  // namespace hitpipe::sim
