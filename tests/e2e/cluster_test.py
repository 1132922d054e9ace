"""Shards on real engines: a job array of Slurm with two nodes on this machine, and GNU parallel."""
import getpass
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

from harness import BAD, FEEDHOLD, GOOD, ORACLES, SKIPPED, Scratch

os.environ["PATH"] += ":/usr/sbin"
SLURM = all(shutil.which(program) for program in ("slurmctld", "slurmd", "sbatch", "munged", "mungekey"))
PARALLEL = shutil.which("parallel")
SHARDS = 4
LONGEST_WAIT = 180
LONGEST_START = 60
CONFIGURATION = """ClusterName=feedhold
SlurmctldHost=localhost
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmctldPort={ports[0]}
SlurmctldPidFile={folder}/ctld.pid
SlurmdPidFile={folder}/d-%n.pid
SlurmdSpoolDir={folder}/spool-%n
StateSaveLocation={folder}/state
SlurmctldLogFile={folder}/ctld.log
SlurmdLogFile={folder}/d-%n.log
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=defer,batch_sched_delay=0,sched_min_interval=1
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
MpiDefault=none
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=100 State=UNKNOWN
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=100 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
SHARD = """#!/bin/sh
"$FEEDHOLD" {command} --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --part "{parts}/$SLURM_ARRAY_TASK_ID.part"
code=$?
echo "$SLURM_ARRAY_TASK_ID on $SLURMD_NODENAME" >> "{parts}/done"
[ $code -le 3 ] && [ $code -ne 2 ]
"""
MERGE = """#!/bin/sh
"$FEEDHOLD" merge "{parts}" > "{parts}/merged" 2> "{parts}/told"
echo $? > "{parts}/code"
"""
MACRO = """O{number}
(@PARAM #1 DEPTH 0.5..60.)
(@PARAM #2 STEP 0.1..20.)
#10=FUP[#1/#2]
WHILE[#10GT0]DO1
#10=#10-1
G91G01Z-#2F100.
END1
#100=1/[#2-{number}]
G65P{helper}A#1
M99
"""


def free_ports(count):
    probes = [socket.socket() for _ in range(count)]
    for probe in probes:
        probe.bind(("127.0.0.1", 0))
    ports = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    return ports


class Engine(Scratch):
    def setUp(self):
        super().setUp()
        self.parts = self.cache / "parts"
        self.parts.mkdir()
        for cell in range(6):
            self.write(f"cell {cell}/O9100.nc", MACRO.format(number=9100, helper=9101))
            self.write(f"cell {cell}/O9101.nc", f"O9101\n#101=5/#1\nG04X{cell}.\nM99\n")
            self.write(f"cell {cell}/O1001.nc", BAD)
            self.write(f"other {cell}/O1000.nc", GOOD.replace("FACING", f"FACING {cell}"))

    def run_(self, *words, **options):
        result = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=self.folder,
                                env=self.environment(), timeout=LONGEST_WAIT, **options)
        self.assertEqual(result.returncode, 0, f"{words}: {result.stdout}{result.stderr}")
        return result.stdout

    def wait_for(self, condition, what, longest=LONGEST_WAIT):
        end = time.monotonic() + longest
        while not condition():
            self.assertLess(time.monotonic(), end, f"{what}\n{self.log()}")
            time.sleep(0.1)

    def log(self):
        return ""

    def assertMerged(self, merged, told, code, command):
        expected = self.feedhold(command)
        self.assertEqual((merged, told, code), (expected.stdout, expected.stderr, expected.returncode))


class Cluster(Engine):
    """A controller and two nodes on this machine."""

    def setUp(self):
        super().setUp()
        self.cluster = self.cache / "cluster"
        for name in ("munge", "state", "spool-n1", "spool-n2"):
            (self.cluster / name).mkdir(parents=True, mode=0o755)
        (self.cluster / "slurm.conf").write_text(
            CONFIGURATION.format(user=getpass.getuser(), folder=self.cluster, ports=free_ports(3)))
        munge = self.cluster / "munge"
        try:
            self.start_cluster(munge)
        except AssertionError as error:
            self.skipTest(f"Slurm does not start on this machine: {error}")

    def start_cluster(self, munge):
        self.run_("mungekey", "--create", "--keyfile", munge / "key")
        self.start("munged", "--foreground", "--force", "--key-file", munge / "key", "--socket", munge / "socket",
                   "--pid-file", munge / "pid", "--log-file", munge / "log", "--seed-file", munge / "seed")
        self.wait_for(lambda: (munge / "socket").exists(), "munged does not start", LONGEST_START)
        self.start("slurmctld", "-D", "-c")
        for node in ("n1", "n2"):
            self.start("slurmd", "-D", "-N", node)
        self.wait_for(lambda: self.states() == ["idle", "idle"], "the nodes do not start", LONGEST_START)

    def environment(self, changes=None):
        own = {"SLURM_CONF": f"{self.cache}/cluster/slurm.conf", "FEEDHOLD": FEEDHOLD}
        return super().environment({**own, **(changes or {})})

    def start(self, *words):
        process = subprocess.Popen([str(word) for word in words], cwd=self.cluster, env=self.environment(),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        def stop():
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

        self.addCleanup(stop)

    def states(self):
        command = ["sinfo", "-h", "-N", "-o", "%t"]
        return subprocess.run(command, capture_output=True, text=True, env=self.environment()).stdout.split()

    def log(self):
        return "\n".join(path.read_text()[-2000:] for path in sorted(self.cluster.glob("*.log")))


@unittest.skipUnless(SLURM, "needs slurm-wlm and munge")
class Slurm(Cluster):
    def submit(self, text, *options):
        script = self.cache / "job.sh"
        script.write_text(text)
        return self.run_("sbatch", "--parsable", "--output", self.cluster / "job-%A-%a.log", *options, script).strip()

    def submit_run(self, command, shard=SHARD):
        for path in self.parts.iterdir():
            path.unlink()
        array = self.submit(shard.format(command=command, parts=self.parts), f"--array=1-{SHARDS}")
        self.submit(MERGE.format(parts=self.parts), f"--dependency=afterok:{array}")
        return array

    def finish(self, command):
        self.wait_for(lambda: (self.parts / "code").exists() and (self.parts / "code").read_text(), "no merge")
        self.assertMerged((self.parts / "merged").read_text(), (self.parts / "told").read_text(),
                          int((self.parts / "code").read_text()), command)

    def tasks(self):
        return [line.split(" ", 1)[0] for line in (self.parts / "done").read_text().splitlines()]

    def test_job_array(self):
        for command in ("check", "prove"):
            with self.subTest(command=command):
                self.submit_run(command)
                self.finish(command)
                self.assertEqual(sorted(self.tasks()), [str(index) for index in range(1, SHARDS + 1)])
                nodes = {line.split()[-1] for line in (self.parts / "done").read_text().splitlines()}
                self.assertEqual(nodes, {"n1", "n2"})

    def test_task_that_is_killed(self):
        """The others go on; the dead one alone is submitted again, and the merge behind it."""
        trap = self.parts / "pid"
        shard = SHARD.replace("$SLURM_ARRAY_TASK_COUNT", str(SHARDS))  # of an array with one task it is 1
        self.submit_run("check", shard.replace('"$FEEDHOLD" {command}', f'[ "$SLURM_ARRAY_TASK_ID" = 2 ] && echo $$ > '
                                               f'"{trap}" && exec sleep {LONGEST_WAIT}\n"$FEEDHOLD" {{command}}'))
        self.wait_for(lambda: trap.exists() and trap.read_text() and (self.parts / "done").exists()
                      and len(self.tasks()) == SHARDS - 1, "the other tasks do not end")
        os.kill(int(trap.read_text()), signal.SIGKILL)
        self.wait_for(lambda: "DependencyNeverSatisfied" in self.run_("squeue", "-h", "-o", "%r"), "the merge is lost")
        self.assertFalse((self.parts / "merged").exists())
        self.assertIn("2 is missing", self.feedhold("merge", self.parts).stderr)
        again = self.submit(shard.format(command="check", parts=self.parts), "--array=2")
        self.submit(MERGE.format(parts=self.parts), f"--dependency=afterok:{again}")
        self.finish("check")


@unittest.skipUnless(PARALLEL, "needs GNU parallel")
class Parallel(Engine):
    def test_shards(self):
        for command in ("check", "prove"):
            with self.subTest(command=command):
                shard = (f"{FEEDHOLD} {command} --shard {{}}/{SHARDS} --part '{self.parts}'/{{}}.part > /dev/null 2>&1; "
                         "[ $? -le 3 ]")
                self.run_("parallel", "--will-cite", "-j2", shard, ":::", *range(1, SHARDS + 1))
                merged = self.feedhold("merge", self.parts)
                self.assertMerged(merged.stdout, merged.stderr, merged.returncode, command)

    def test_job_that_is_killed(self):
        """The first try of shard 3 is killed; parallel starts it again."""
        trap = self.cache / "tried"
        shard = (f"if [ {{}} = 3 ] && mkdir '{trap}' 2> /dev/null; then kill -9 $$; fi; "
                 f"{FEEDHOLD} check --shard {{}}/{SHARDS} --part '{self.parts}'/{{}}.part > /dev/null 2>&1; "
                 "[ $? -le 1 ]")
        self.run_("parallel", "--will-cite", "-j2", "--retries", "2", shard, ":::", *range(1, SHARDS + 1))
        self.assertTrue(trap.exists())
        merged = self.feedhold("merge", self.parts)
        self.assertMerged(merged.stdout, merged.stderr, merged.returncode, "check")


if __name__ == "__main__":
    if not ORACLES or not (SLURM or PARALLEL):
        print("skipped: needs Slurm or GNU parallel; run `./dev test --oracles`")
        sys.exit(SKIPPED)
    unittest.main()
